# Chutes of spheres in LAMMPS, LIGGGHTS and YADE, and what docs/studies/three-dimensions.md says of them.
#
#   make -f scripts/archives/chute3d.mk archives     the archives in OUT; continues where it was stopped
#   make -f scripts/archives/chute3d.mk stress       the programs' own stress beside that from their contacts
#   make -f scripts/archives/chute3d.mk fits         B(p), p*, exponents, fractions of the stress, classes of sizes
#   make -f scripts/archives/chute3d.mk figures      OUT/fits/b-of-p.png and stress-fractions.png
#
# Variables: OUT (chute3d), BIN (build/bin).

ROOT := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))/../..
HERE := $(ROOT)/scripts/archives
OUT ?= chute3d
BIN ?= $(ROOT)/build/bin

# Flows of chute3d.lammps: seeds, parts and words for lmp.
flows := long mix70 three any
seeds_long := 1 2 3
seeds_mix70 := 1 2
seeds_three := 1
seeds_any := 1
parts_long := 1
parts_mix70 := 1
parts_three := 3
parts_any := 3
words_mix70 := -var large 0.7 -var grains 1350
words_three := -var mixture three -var frames 60
words_any := -var mixture any -var along 8 -var across 7 -var frames 60

comma := ,
empty :=
species_three := --species S=2 --species M=3 --species L=4
species_any := --species any=2
two := --small 2 --large 3
units := --units 1:1:1 --step 8.8e-4 --gravity 1 --slope 26
turned := $(units) --axes xz --boundary 1
# young collisions of large grains, mostly damping, miss up to 0.18 of the largest force half a step later, 0.056 unexplained
late_long := --accept-residual 0.1
late_mix70 := --accept-residual 0.1
outputs := 0.0088
import := $(BIN)/grseg-import --quiet --overwrite

.PHONY: archives stress fits figures help
.DELETE_ON_ERROR:
.SECONDARY:
help:
	@sed -n '1,/^$$/s/^# \{0,1\}//p' $(lastword $(MAKEFILE_LIST))

# Archives

stamps := $(flows:%=$(OUT)/%/made) $(patsubst %,$(OUT)/%/made,elastic/two elastic/three liggghts/damped liggghts/elastic yade)
archives: $(stamps)

$(flows:%=$(OUT)/%/made): $(OUT)/%/made:
	nice $(HERE)/chute3d-parts $(@D) --seeds $(subst $(empty) ,$(comma),$(strip $(seeds_$*))) --parts $(parts_$*) \
	  -- -var digits 9 $(words_$*)
	touch $@

$(OUT)/elastic/two/made: $(OUT)/long/made
$(OUT)/elastic/three/made: $(OUT)/three/made
$(OUT)/elastic/%/made:
	mkdir -p $(@D)
	cd $(@D) && lmp -in $(HERE)/chute3d.lammps -log none -screen none -var part elastic \
	  -var from $(abspath $(<D))/1/p1.restart -var damped 0 -var every 10 -var frames 6
	touch $@

$(OUT)/liggghts/damped/made: words :=
$(OUT)/liggghts/elastic/made: words := -var damped 0 -var every 10 -var frames 6
$(OUT)/liggghts/%/made:
	mkdir -p $(@D)
	cd $(@D) && liggghts -in $(HERE)/chute3d.liggghts -screen none $(words)
	touch $@

$(OUT)/yade/made:
	mkdir -p $(@D)
	cd $(@D) && yade -x -n -j1 $(HERE)/chute3d_yade.py
	touch $@

# Runs

runs = $(foreach seed,$(seeds_$(1)),$(OUT)/runs/$(1)-$(seed).h5)
define runs_of_flow
$(call runs,$(1)): $(OUT)/runs/$(1)-%.h5: $(OUT)/$(1)/made
	mkdir -p $$(@D)
	$$(import) --format lammps --grains '$(OUT)/$(1)/$$*/atoms-p*.dump.gz' \
	  --contacts '$(OUT)/$(1)/$$*/contacts-p*.dump.gz' $$(turned) $(or $(species_$(1)),$(two)) $(late_$(1)) -o $$@
endef
$(foreach flow,$(flows),$(eval $(call runs_of_flow,$(flow))))

$(OUT)/runs/elastic-%.h5: $(OUT)/elastic/%/made
	mkdir -p $(@D)
	$(import) --format lammps --grains $(<D)/atoms-elastic.dump.gz --contacts $(<D)/contacts-elastic.dump.gz \
	  $(turned) $(or $(species_$*),$(two)) -o $@
$(OUT)/runs/liggghts-%.h5: $(OUT)/liggghts/%/made
	mkdir -p $(@D)
	$(import) --format liggghts --columns liggghts-full35 --grains $(<D)/atoms.dump --contacts $(<D)/contacts.dump \
	  $(turned) $(two) -o $@
$(OUT)/runs/yade.h5: $(OUT)/yade/made
	mkdir -p $(@D)
	$(import) --format csv --grains $(<D)/grains.csv --contacts $(<D)/contacts.csv $(units) $(two) -o $@

# The programs' own stress

compared := $(patsubst %,$(OUT)/stress/%.tsv,elastic-two elastic-three liggghts-elastic liggghts-damped long-1 three-1 yade)
stress: $(compared)
	@awk -F'\t' 'FNR == 1 { split("", of); for (k = 1; k <= NF; ++k) if ($$k == "difference") of[k]; next } \
	  { for (k in of) { d = $$k < 0 ? -$$k : +$$k; if ($$k != "nan" && d > most[FILENAME]) most[FILENAME] = d } } \
	  END { for (file in most) print most[file], file }' $^

$(OUT)/stress/long-1.tsv $(OUT)/stress/three-1.tsv $(OUT)/stress/liggghts-damped.tsv: outputs := 1.76
dumps_elastic-two = $(OUT)/elastic/two/atoms-elastic.dump.gz
dumps_elastic-three = $(OUT)/elastic/three/atoms-elastic.dump.gz
dumps_liggghts-elastic = $(OUT)/liggghts/elastic/atoms.dump
dumps_liggghts-damped = $(OUT)/liggghts/damped/atoms.dump
dumps_long-1 = $(sort $(wildcard $(OUT)/long/1/atoms-p*.dump.gz))
dumps_three-1 = $(sort $(wildcard $(OUT)/three/1/atoms-p*.dump.gz))

$(OUT)/stress/yade.tsv: $(OUT)/runs/yade.h5
	mkdir -p $(@D)
	$(BIN)/grseg-stress $< --layer 200dS --window 1.76 --quiet --overwrite -o $(@D)/yade.sums.tsv
	$(HERE)/body-stress $(OUT)/yade/grains.csv $(OUT)/yade/stress.csv $(@D)/yade.sums.tsv > $@
$(OUT)/stress/%.tsv: $(OUT)/runs/%.h5
	mkdir -p $(@D)
	$(BIN)/grseg-stress $< --assign grain --window $(outputs) --quiet --overwrite -o $(@D)/$*.sums.tsv
	$(HERE)/stress-atom $< $(@D)/$*.sums.tsv $(dumps_$*) --axes xz --printed $(@D)/$*.printed.tsv > $@

# Fits: of layers 4 m thick, which is 4 dS but for classes, whose smallest is larger than the smallest grain

windows := --layer 4dS --window 17.6 --begin 308 --quiet --overwrite
classes := 2 4 8
$(OUT)/sums/%.stress.tsv: $(OUT)/runs/%.h5
	mkdir -p $(@D)
	$(BIN)/grseg-stress $< $(windows) -o $@
$(OUT)/sums/%.kinetic.tsv: $(OUT)/runs/%.h5
	mkdir -p $(@D)
	$(BIN)/grseg-kinetic $< --mean species $(windows) -o $@
$(classes:%=$(OUT)/sums/any-%.tsv): $(OUT)/sums/any-%.tsv: $(OUT)/runs/any-1.h5
	mkdir -p $(@D)
	$(BIN)/grseg-stress $< --classes $* $(windows) -o $@
	$(BIN)/grseg-kinetic $< --classes $* --mean species $(windows) -o $(@:.tsv=.kinetic.tsv)

two_sizes := long mix70
tables = $(foreach seed,$(seeds_$(1)),$(2:%=$(OUT)/sums/$(1)-$(seed).%.tsv))
fit := $(BIN)/grseg-fit --heights 4dS:20dS --quiet --overwrite
many := --exponent --partition stock,uniform:0.8

fits: $(foreach what,stock scan pressure kinetic fractions,$(two_sizes:%=$(OUT)/fits/%.$(what).tsv)) \
  $(OUT)/fits/three.tsv $(classes:%=$(OUT)/fits/any-%.tsv)

define fits_of_flow
$(OUT)/fits/$(1).stock.tsv: $(call tables,$(1),stress)
	mkdir -p $$(@D)
	$$(fit) $$^ --partition stock --exponent -o $$@
$(OUT)/fits/$(1).pressure.tsv: $(call tables,$(1),stress)
	mkdir -p $$(@D)
	$$(fit) $$^ --component pressure --exponent -o $$@
$(OUT)/fits/$(1).scan.tsv: $(call tables,$(1),stress)
	mkdir -p $$(@D)
	$$(fit) $$^ --scan 0.4:0.9:0.005 -o $$@
$(OUT)/fits/$(1).kinetic.tsv: $(call tables,$(1),kinetic)
	mkdir -p $$(@D)
	$$(fit) $$^ --quantity kinetic --exponent -o $$@
$(OUT)/fits/$(1).fractions.tsv: $(call tables,$(1),stress kinetic)
	mkdir -p $$(@D)
	$$(HERE)/stress-fractions $$^ --heights 4:20 > $$@
endef
$(foreach flow,$(two_sizes),$(eval $(call fits_of_flow,$(flow))))
$(OUT)/fits/three.tsv: $(OUT)/sums/three-1.stress.tsv
	mkdir -p $(@D)
	$(fit) $^ $(many) -o $@
$(classes:%=$(OUT)/fits/any-%.tsv): $(OUT)/fits/any-%.tsv: $(OUT)/sums/any-%.tsv
	mkdir -p $(@D)
	$(fit) $< $(many) -o $@
	$(HERE)/stress-fractions $< $(<:.tsv=.kinetic.tsv) --heights 4:20 > $(@:.tsv=.fractions.tsv)

exponent = $$(awk '/^. exponent $(1):/ { print $$4 }' $(OUT)/fits/long.fractions.tsv)
figures: $(OUT)/fits/long.scan.tsv $(OUT)/fits/long.stock.tsv $(two_sizes:%=$(OUT)/fits/%.fractions.tsv)
	cp $(OUT)/fits/long.scan.tsv $(OUT)/fits/scan.tsv
	cp $(OUT)/fits/long.stock.tsv $(OUT)/fits/stock.tsv
	gnuplot -c $(ROOT)/scripts/figures/b-of-p.gp $(OUT)/fits
	gnuplot -c $(ROOT)/scripts/figures/stress-fractions.gp $(OUT)/fits $(call exponent,contact) $(call exponent,kinetic)
