# Checks of the values that users pass to make, so that they cannot run anything: included by Makefile,
# reproduce/Makefile and reproduce/document.mk.

# Folder where make was called, unless another make sets it, and folder of the programs.
HERE ?= $(or $(value PWD),$(CURDIR))
BIN ?= $(dir $(abspath $(lastword $(MAKEFILE_LIST))))../build/bin

# The comment at the top of the Makefile; no default goal.
.PHONY: help FORCE
help:
	@sed -n '1,/^$$/s/^# \{0,1\}//p' $(firstword $(MAKEFILE_LIST))
.DEFAULT_GOAL :=

# quote TEXT: one word for the shell. quote_each LIST: so is each of its words.
quote = '$(subst ','\'',$(1))'
quote_each = $(foreach word,$(1),$(call quote,$(word)))

absolute = $(foreach path,$(1),$(if $(filter /%,$(path)),$(path),$(HERE)/$(path)))

empty :=
blank := $(empty) $(empty)
tab := $(empty)	$(empty)
define newline


endef
# Make runs what stands behind a dollar sign, and a line break ends a command.
in_no_value := $$
# To make these are more than letters of a name, and to the shell, of which names are not kept here.
in_no_name := $$ \# % : ; = & | \ * ? [ ] ( ) { } < > ~ ! ' " `

# given VARIABLE: its value as given, not expanded; if it was not given, the Makefile's default.
given = $(if $(filter file,$(origin $(1))),$($(1)),$(value $(1)))
# first_of CHARACTERS,VARIABLE: the first of them that the variable holds.
first_of = $(firstword $(foreach character,$(1),$(findstring $(character),$(call given,$(2)))))
title_HERE := the folder where make was called
refuse = $(error $(or $(title_$(1)),$(1)) holds $(2); $(3))
check = $(if $(call first_of,$(1),$(3)),$(call refuse,$(3),$(call first_of,$(1),$(3)),$(2)))$(if \
  $(findstring $(newline),$(call given,$(3))),$(call refuse,$(3),a line break,$(2)))
blanks = $(findstring $(blank),$(call given,$(1)))$(findstring $(tab),$(call given,$(1)))

# check_values, check_lists, check_names VARIABLES: make ends with one sentence if one of these values, lists
# of names or names cannot be used, before anything is run. check_unknown: also where the command line gives another
# variable than these.
advice := make cannot take that in names; choose another, or rename the file
check_values = $(eval known += $(1))$(foreach variable,$(1),$(call check,$(in_no_value),write it without,$(variable)))
check_lists = $(eval known += $(1))$(foreach variable,$(1),$(call check,$(in_no_name),$(advice),$(variable)))
check_names = $(call check_lists,$(1))$(foreach variable,$(1),$(if $(call blanks,$(variable)),$(call refuse,$(variable),a blank,$(advice))))
# All that is on the command line: make expands it for the environment of commands, used or not.
on_command_line = $(filter command,$(firstword $(origin $(1))))
given_names := $(foreach variable,$(.VARIABLES),$(if $(call on_command_line,$(variable)),$(variable)))
$(foreach variable,$(given_names),$(call check,$(in_no_value),write it without,$(variable)))
check_unknown = $(foreach variable,$(filter-out $(known),$(given_names)),$(error $(variable) is unknown here; there are $(sort $(known))))
