# Makes one run in its folder: scene.ini -> run.h5 -> TABLES (and PAGE, page.html) -> checksums. Called by Makefile and
# ../sweep/Makefile.

include $(scripts)/../values.mk
run := $(call quote_each,$(RUN))
campaign := /usr/bin/python3 $(scripts)/campaign

.PHONY: done FORCE
.DELETE_ON_ERROR:
.SUFFIXES:
# The trajectory is not needed once the tables exist.
.SECONDARY: run.h5

done: checksums
	@:
# checksums is made last, after the trajectory is deleted: a run with this file is finished.
checksums: $(TABLES) $(PAGE) cost.tsv
	$(if $(KEEP),,rm -f run.chk run_prev.chk run.h5)
	rm -f *.lock *.part
	sha256sum $(sort $(TABLES)) > $@.new
	mv $@.new $@
	$(if $(PAGE),@echo '$(notdir $(CURDIR)) is finished')

run.h5: scene.ini
	$(run) $(campaign) simulate $(bin)/grseg-sim $(call quote,$(CHECKPOINT_EVERY))

# Options for the words in the name of a table, after its tool; strideN: every N-th frame.
word_branch := --assign branch
word_grain := --assign grain
word_gauss := --assign gauss
word_centre := --composition centre
word_1dS := --layer 1dS
word_2dS := --layer 2dS
word_8dS := --layer 8dS
# Random labels change the content of the trajectory, so its seal is no longer valid.
word_random := --trust
word_layer := --mean layer
word_instant := --mean instant
word_unbiased := --mean instant-unbiased
word_others := --mean profile-unbiased
word_middle := --velocity middle
word_rules := --partition size,half,drop
SUMMARY_HEIGHTS ?= 4dS:56dS
word_summary := --summary --heights $(SUMMARY_HEIGHTS)
options_of = $(if $(filter check,$(1)),--physics) \
  $(foreach word,$(wordlist 2,9,$(subst -, ,$(1))),$(or $(word_$(word)),$(patsubst stride%,--stride %,$(filter stride%,$(word)))))

# The control: equal grains with random labels; any choice of the large grains is equivalent.
trajectory_stress-random := random.h5.part

extracts := $(filter record.tsv observables.tsv snapshots.tsv,$(TABLES))
sums := $(filter-out $(extracts),$(TABLES))
# command_of TABLE: the command that makes the table, as the table's history records it.
command_of = $(strip grseg-$(firstword $(subst -, ,$(1))) $(or $(trajectory_$(1)),run.h5) --window $(WINDOW) $(options_of) --quiet)

# The page computes B from stress.tsv, whose history has no restarts.
PAGE_BEGIN ?= 0
command_of_page := grseg-explore run.h5 stress.tsv --window $(WINDOW) --heights $(SUMMARY_HEIGHTS) --begin $(PAGE_BEGIN) --quiet --overwrite -o page.html

# Tables and pages that were made by another command than now are made again.
outdated := $(shell $(campaign) outdated $(call quote,$(AGAIN)) $(extracts) $(if $(PAGE),$(call quote,$(PAGE): $(command_of_page))) $(foreach table,$(sums:.tsv=),$(call quote,$(table).tsv: $(call command_of,$(table)))))
$(if $(filter-out 0,$(.SHELLSTATUS)),$(error $(notdir $(CURDIR)): which tables are outdated is unknown; see the message above))
$(if $(filter gone,$(outdated)),$(error $(notdir $(CURDIR)): $(filter-out gone,$(outdated)): missing, or made by another \
  command than now, and the trajectory was deleted; AGAIN=yes simulates the run again))
$(outdated): FORCE

table = $(run) $(campaign) table $@
$(filter-out stress-random.tsv,$(sums)): run.h5
	$(table) $(bin)/$(call quote_each,$(call command_of,$(basename $@)))
$(extracts): run.h5
	$(table) $(campaign) extract $(basename $@) run.h5
stress-random.tsv: run.h5
	$(run) $(campaign) relabel run.h5 $(trajectory_stress-random)
	$(table) $(bin)/$(call quote_each,$(call command_of,$(basename $@)))
	rm $(trajectory_stress-random)

page.html: run.h5 stress.tsv
	$(run) $(bin)/$(call quote_each,$(command_of_page))

# Wall times. No checksum includes them, so that checksums are the same for an interrupted and an uninterrupted run.
cost.tsv: run.h5 $(TABLES)
	$(campaign) cost > $@.new
	mv $@.new $@
