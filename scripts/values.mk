# Checks that values which users pass to make cannot run commands. Included by Makefile, reproduce/Makefile and
# reproduce/document.mk.

# HERE: folder where make was called, unless another make sets it. BIN: folder of the programs.
HERE ?= $(or $(value PWD),$(CURDIR))
of_scripts := $(dir $(abspath $(lastword $(MAKEFILE_LIST))))
# The programs of a clone, or those installed with these scripts in share/grseg/scripts.
BIN ?= $(firstword $(wildcard $(of_scripts)../build/bin $(of_scripts)../../../bin) $(of_scripts)../build/bin)

# help prints the comment at the top of the Makefile. There is no default goal.
.PHONY: help FORCE
help:
	@sed -n '1,/^$$/s/^# \{0,1\}//p' $(firstword $(MAKEFILE_LIST))
.DEFAULT_GOAL :=

# quote TEXT: TEXT as one word for the shell. quote_each LIST: each word of LIST, quoted for the shell.
quote = '$(subst ','\'',$(1))'
quote_each = $(foreach word,$(1),$(call quote,$(word)))

absolute = $(foreach path,$(1),$(if $(filter /%,$(path)),$(path),$(HERE)/$(path)))

empty :=
blank := $(empty) $(empty)
tab := $(empty)	$(empty)
define newline


endef
# Characters that no value may contain: make expands text after a dollar sign. (A line break ends a command.)
in_no_value := $$
# Characters that no name may contain: they have a special meaning for make or for the shell.
in_no_name := $$ \# % : ; = & | \ * ? [ ] ( ) { } < > ~ ! ' " `

# given VARIABLE: its value as given, not expanded; the Makefile's default if none was given.
given = $(if $(filter file,$(origin $(1))),$($(1)),$(value $(1)))
# first_of CHARACTERS,VARIABLE: the first of the characters that the variable contains.
first_of = $(firstword $(foreach character,$(1),$(findstring $(character),$(call given,$(2)))))
title_HERE := the folder where make was called
refuse = $(error $(or $(title_$(1)),$(1)) contains $(2); $(3))
check = $(if $(call first_of,$(1),$(3)),$(call refuse,$(3),$(call first_of,$(1),$(3)),$(2)))$(if \
  $(findstring $(newline),$(call given,$(3))),$(call refuse,$(3),a line break,$(2)))
blanks = $(findstring $(blank),$(call given,$(1)))$(findstring $(tab),$(call given,$(1)))

# check_values, check_lists, check_names VARIABLES: make ends with an error, before it runs anything, if one of these
# values, lists of names, or names cannot be used. check_unknown: make ends with an error if the command line sets a
# variable that was not checked.
advice := make cannot use that in names; choose another name, or rename the file
check_values = $(eval known += $(1))$(foreach variable,$(1),$(call check,$(in_no_value),write it without,$(variable)))
check_lists = $(eval known += $(1))$(foreach variable,$(1),$(call check,$(in_no_name),$(advice),$(variable)))
check_names = $(call check_lists,$(1))$(foreach variable,$(1),$(if $(call blanks,$(variable)),$(call refuse,$(variable),a blank,$(advice))))
# All variables on the command line: make expands them for the environment of commands, even if it does not use them.
on_command_line = $(filter command,$(firstword $(origin $(1))))
given_names := $(foreach variable,$(.VARIABLES),$(if $(call on_command_line,$(variable)),$(variable)))
$(foreach variable,$(given_names),$(call check,$(in_no_value),write it without,$(variable)))
check_unknown = $(foreach variable,$(filter-out $(known),$(given_names)),$(error $(variable) is unknown here; there are $(sort $(known))))
