# One run, in its own folder: scene.ini -> run.h5 -> TABLES -> checksums. Called by Makefile.

.DELETE_ON_ERROR:
.SUFFIXES:
# Where its tables are there, the trajectory need not be.
.SECONDARY: run.h5

# Last, when the trajectory is gone: a run that has this file is done.
checksums: $(TABLES) cost.tsv
	$(if $(KEEP),,rm -f run.chk run.h5)
	rm -f run.lock *.part
	sha256sum $(sort $(TABLES)) > $@.new
	mv $@.new $@

run.h5: scene.ini
	$(RUN) $(scripts)/simulate $(bin)/grseg-sim $(CHECKPOINT_EVERY)

stress-branch.tsv: options := --assign branch
stress-grain.tsv: options := --assign grain
stress-gauss.tsv: options := --assign gauss
stress-centre.tsv: options := --composition centre
stress-2dS.tsv: options := --layer 2dS
stress-8dS.tsv: options := --layer 8dS
stress-stride2.tsv: options := --stride 2
stress-stride5.tsv: options := --stride 5
kinetic-layer.tsv: options := --mean layer
kinetic-instant.tsv: options := --mean instant
check.tsv: options := --physics
segregation-summary.tsv: options := --summary --heights 4dS:56dS

table = $(RUN) $(scripts)/table $@
tool = $(bin)/grseg-$(firstword $(subst -, ,$(basename $@)))
extracts := record.tsv observables.tsv snapshots.tsv
$(filter-out $(extracts) stress-random.tsv,$(TABLES)): run.h5 ../.window
	$(table) $(tool) run.h5 --window $(WINDOW) $(options) --quiet
$(extracts): run.h5
	$(table) $(scripts)/extract $(basename $@) run.h5
# Of grains that are all alike, any half may be called large.
stress-random.tsv: run.h5 ../.window
	$(RUN) $(scripts)/relabel run.h5 random.h5.part
	$(table) $(tool) random.h5.part --window $(WINDOW) --quiet
	rm random.h5.part

# Wall time, which no checksum covers: a table is the same whatever befell its run.
cost.tsv: run.h5 $(TABLES)
	$(scripts)/cost > $@.new
	mv $@.new $@
