# One run, in its own folder: scene.ini -> run.h5 -> TABLES -> checksums. Called by Makefile.

include $(scripts)/../values.mk
run := $(call quote_each,$(RUN))

.PHONY: done FORCE
.DELETE_ON_ERROR:
.SUFFIXES:
# The trajectory is not needed once the tables exist.
.SECONDARY: run.h5

done: checksums
	@:
# Made last, after the trajectory is deleted: a run that has this file is finished.
checksums: $(TABLES) cost.tsv
	$(if $(KEEP),,rm -f run.chk run_prev.chk run.h5)
	rm -f *.lock *.part
	sha256sum $(sort $(TABLES)) > $@.new
	mv $@.new $@

run.h5: scene.ini
	$(run) $(scripts)/simulate $(bin)/grseg-sim $(call quote,$(CHECKPOINT_EVERY))

options_stress-branch := --assign branch
options_stress-grain := --assign grain
options_stress-gauss := --assign gauss
options_stress-centre := --composition centre
options_stress-2dS := --layer 2dS
options_stress-8dS := --layer 8dS
# Its labels were drawn anew, so the seal of the trajectory does not hold.
options_stress-random := --trust
options_stress-stride2 := --stride 2
options_stress-stride5 := --stride 5
options_kinetic-layer := --mean layer
options_kinetic-instant := --mean instant
options_balance-rules := --partition size,half,drop
options_kinetic-unbiased := --mean instant-unbiased
options_kinetic-middle := --velocity middle
options_kinetic-unbiased-middle := --mean instant-unbiased --velocity middle
options_check := --physics
options_segregation-summary := --summary --heights 4dS:56dS

# Among equal grains any half may be labelled large.
trajectory_stress-random := random.h5.part

extracts := record.tsv observables.tsv snapshots.tsv
sums := $(filter-out $(extracts),$(TABLES))
# command_of TABLE: as recorded in the history of that table.
command_of = $(strip grseg-$(firstword $(subst -, ,$(1))) $(or $(trajectory_$(1)),run.h5) --window $(WINDOW) $(options_$(1)) --quiet)

# Tables that were made by another command are made again.
outdated := $(shell $(scripts)/outdated $(call quote,$(AGAIN)) $(extracts) $(foreach table,$(sums:.tsv=),$(call quote,$(table).tsv: $(call command_of,$(table)))))
$(if $(filter gone,$(outdated)),$(error $(notdir $(CURDIR)): $(filter-out gone,$(outdated)): missing, or made by another \
  command than now, and the trajectory was deleted; AGAIN=yes simulates the run again))
$(outdated): FORCE

table = $(run) $(scripts)/table $@
$(filter-out stress-random.tsv,$(sums)): run.h5
	$(table) $(bin)/$(call command_of,$(basename $@))
$(extracts): run.h5
	$(table) $(scripts)/extract $(basename $@) run.h5
stress-random.tsv: run.h5
	$(run) $(scripts)/relabel run.h5 $(trajectory_stress-random)
	$(table) $(bin)/$(call command_of,$(basename $@))
	rm $(trajectory_stress-random)

# Wall times, which no checksum covers: tables are the same whether or not their run was interrupted.
cost.tsv: run.h5 $(TABLES)
	$(scripts)/cost > $@.new
	mv $@.new $@
