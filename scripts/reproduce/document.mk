# Figures, numbers and docs/studies/reproduction.md from the tables of the campaign, or from the archived tables in
# data/reproduction. Nothing is simulated and no trajectory is read.
#
#   make -C scripts reproduction.md                    docs/studies/reproduction.md, its annex and figures, from data/reproduction
#   make -C scripts reproduction.md TABLES=FOLDER      the same, from the tables that make reproduce wrote into FOLDER
#   make -C scripts three-dimensions.md                the tables of docs/studies/three-dimensions.md, from data/reproduction
#   make -C scripts figures/kinetic-profile.png        one figure, in the folder WORK; .pdf for a publication
#   make -C scripts kept TABLES=FOLDER                 makes data/reproduction again from the tables in FOLDER
#
# Relative names refer to the folder where make was called.

include ../values.mk

KEPT := $(CURDIR)/../../data/reproduction
TABLES ?=
WORK ?= reproduction-figures
DOCUMENT ?= $(CURDIR)/../../docs/studies/reproduction.md
# If DOCUMENT is another page, an annex is written only if ANNEX names one.
ANNEX ?= $(if $(filter file,$(origin DOCUMENT)),$(DOCUMENT:.md=-annex.md))
SPHERES ?= $(CURDIR)/../../docs/studies/three-dimensions.md
PICTURES ?= $(CURDIR)/../../docs/studies/figures/reproduction

$(call check_names,HERE BIN TABLES WORK DOCUMENT ANNEX PICTURES SPHERES)
reduce := /usr/bin/python3 $(CURDIR)/campaign
work := $(call absolute,$(WORK))
bin := $(call absolute,$(BIN))
tables := $(if $(TABLES),$(call absolute,$(TABLES)),$(work)/kept)
gp := ../figures

.PHONY: reproduction.md three-dimensions.md figures choices.tsv kept
.DELETE_ON_ERROR:
.SUFFIXES:

reproduction.md:
# The archived tables are unpacked before make looks for runs.
ifeq ($(TABLES),)
unpacked := $(shell $(reduce) unpack $(KEPT) $(tables) >&2 || echo no)
$(if $(unpacked),$(error data/reproduction has no tables that can be unpacked; name a folder with tables: TABLES=FOLDER))
endif
runs := $(sort $(patsubst %/checksums,%,$(wildcard $(tables)/*/checksums)))
$(if $(runs),,$(error $(tables) has no finished run; name the folder that make reproduce filled: TABLES=FOLDER))

# of FLOWS,QUANTITY: the tables of all seeds of these flows.
of = $(strip $(foreach flow,$(1),$(patsubst %,%/$(2).tsv,$(filter $(tables)/$(flow)-seed%,$(runs)))))
mixtures := $(foreach phi,0.06 0.15 0.30 0.45 0.60 0.75,phi$(phi)-s23)
slopes := $(foreach slope,21 22 23 24 25 26,phi0.45-s$(slope))

# Figures that can be drawn from the flows in TABLES.
names := $(if $(call of,phi0.30-s23,stress),snapshots pressure-profile kinetic-profile balance) \
  $(if $(call of,$(mixtures),stress),stress-ratio mixed-share kinetic-ratio pressure-estimates b-of-p b-of-flows b-of-composition) \
  $(if $(call of,phi0.45-s23,stress),micro-over-time step) $(if $(call of,$(slopes),stress),kinetic-shear-rate) \
  $(if $(wildcard $(KEPT)/combinations.tsv),combinations)
pictures := $(names:%=$(work)/%.png)
prints := $(names:%=$(work)/%.pdf)
figures: $(pictures)
.PHONY: $(names:%=figures/%.png) $(names:%=figures/%.pdf)
$(names:%=figures/%.png) $(names:%=figures/%.pdf): figures/%: $(work)/%

inside := --heights 4dS:56dS --quiet
# One B for all mixtures, as Staron & Phillips published it (docs/studies/uncertainty.md).
fit = $(bin)/grseg-fit --over flows $(inside) --overwrite -o $@
micro = $(bin)/grseg-derive --overwrite -o $@
code = $(1:%=campaign/%.py) campaign/tables.py ../shared.py
every := $(foreach run,$(runs),$(wildcard $(run)/*.tsv))

$(work):
	mkdir -p $@

# Tables of all mixtures: concatenated, for fit-points, or with all rows in one table.
$(work)/stress.tsv $(work)/kinetic.tsv: $(work)/%.tsv: $(every) | $(work)
	cat $(call of,$(mixtures),$*) > $@
$(work)/micro.tsv: $(work)/%.tsv: $(every) | $(work)
	awk 'FNR == 1 { body = 0 } /^#/ { next } body++ || !named++' $(call of,$(mixtures),$*) > $@
$(work)/fit.tsv: $(every) | $(work)
	$(fit) $(call of,$(mixtures),stress) --fit paper
$(work)/scan.tsv: $(every) | $(work)
	$(fit) $(call of,$(mixtures),stress) --scan 0.4:0.9:0.025
$(work)/stock.tsv: $(every) | $(work)
	$(fit) $(call of,$(mixtures),stress) --partition stock --fit paper
$(work)/kinetic-fit.tsv: $(every) | $(work)
	$(fit) $(call of,$(mixtures),kinetic) --quantity kinetic --fit paper
$(work)/paper.tsv: $(every) | $(work)
	$(micro) $(call of,$(mixtures),micro) $(inside) --pool composition --preset paper
$(work)/ends.tsv: $(every) | $(work)
	$(micro) $(call of,$(mixtures),micro) $(inside) --pool composition --force normal --average ends
$(work)/time.tsv: $(every) | $(work)
	$(micro) $(firstword $(call of,phi0.45-s23,micro)) --quiet
$(work)/profile.tsv: $(every) $(call code,profiles) ../profile | $(work)
	../profile $(call of,phi0.30-s23,stress) --kinetic $(call of,phi0.30-s23,kinetic) --last-third > $@
$(work)/balance-profile.tsv: $(every) $(call code,profiles) ../profile | $(work)
	../profile --balance $(call of,phi0.30-s23,balance) > $@
$(work)/snapshots.tsv: $(every) | $(work)
	cp $(firstword $(call of,phi0.30-s23,snapshots)) $@
$(work)/fits.tsv: $(every) $(call code,fits) | $(work)
	$(reduce) fits $(tables) -o $@ --bin $(bin)
$(work)/flows.tsv: $(work)/fits.tsv $(call code,flows)
	$(reduce) flows $(tables) $< -o $@ --bin $(bin)
# The tables from which choices.tsv is made are not archived; choices.tsv itself is.
$(work)/choices.tsv: $(every) $(call code,fits) | $(work)
	$(if $(TABLES),$(reduce) choices $(tables) -o $@ --bin $(bin),cp $(KEPT)/choices.tsv $@)
# combinations.tsv needs trajectories, so it is archived.
$(work)/combinations.tsv: $(KEPT)/combinations.tsv | $(work)
	cp $< $@
$(work)/combined.tsv: $(work)/combinations.tsv $(call code,combinations combined)
	$(reduce) combinations $< --figure $@ > /dev/null
# Spheres have tables of their own, which are archived.
$(work)/spheres.tsv: $(KEPT)/spheres.tar.bz2 $(call code,spheres rise) | $(work)
	rm -rf $(work)/spheres && mkdir $(work)/spheres && tar -xjf $< -C $(work)/spheres
	$(reduce) spheres $(work)/spheres -o $@ --bin $(bin)
$(work)/numbers.tsv: $(every) $(call code,measures rise profiles) | $(work)
	$(reduce) numbers $(tables) -o $@ --bin $(bin)

# Figures and the tables that they need; a picture is a PNG or a PDF, by the end of its name.
both = $(foreach name,$(1),$(work)/$(name).png $(work)/$(name).pdf)
$(call both,snapshots): $(work)/snapshots.tsv
$(call both,pressure-profile kinetic-profile): $(work)/profile.tsv
$(call both,stress-ratio): $(work)/stress.tsv $(work)/fit.tsv
$(call both,mixed-share): $(work)/micro.tsv
$(call both,kinetic-shear-rate step): $(work)/flows.tsv
$(call both,pressure-estimates): $(work)/paper.tsv $(work)/ends.tsv
$(call both,micro-over-time): $(work)/time.tsv
$(call both,b-of-p): $(work)/scan.tsv $(work)/stock.tsv
$(call both,b-of-flows): $(work)/fits.tsv
$(call both,b-of-composition): $(work)/numbers.tsv $(work)/spheres.tsv
$(call both,combinations): $(work)/combined.tsv
$(call both,balance): $(work)/balance-profile.tsv
$(call both,kinetic-ratio): $(work)/kinetic.tsv $(work)/kinetic-fit.tsv $(gp)/stress-ratio.gp
$(call both,stress-ratio kinetic-ratio): $(gp)/fit-points
draw = gnuplot -c $(gp)/$(1).gp $(work) $(2) $@
$(pictures) $(prints): $(gp)/names.gp
$(filter-out $(work)/kinetic-ratio.%,$(pictures)): $(work)/%.png: $(gp)/%.gp
	$(call draw,$*)
$(filter-out $(work)/kinetic-ratio.%,$(prints)): $(work)/%.pdf: $(gp)/%.gp
	$(call draw,$*)
$(work)/kinetic-ratio.png $(work)/kinetic-ratio.pdf:
	$(call draw,stress-ratio,kinetic)

choices.tsv: $(work)/choices.tsv

# In the document and its annex only the generated parts are replaced.
reproduction.md: $(pictures) $(addprefix $(work)/,flows.tsv fits.tsv numbers.tsv scan.tsv choices.tsv combinations.tsv)
	mkdir -p $(PICTURES)
	cp $(pictures) $(PICTURES)
	$(reduce) document $(work) $(DOCUMENT) $(ANNEX)

# Only the generated tables are replaced.
three-dimensions.md: $(work)/spheres.tsv
	$(reduce) answers $(work) $(SPHERES)

kept: $(work)/choices.tsv
	@test -n "$(TABLES)" || { echo "name the tables to keep: TABLES=FOLDER" >&2; exit 2; }
	@test -n "$(filter $(tables)/phi0.45-s23-e%,$(runs))" || { echo "$(tables) has no sensitivities, which data/reproduction needs: make -C scripts sensitivities" >&2; exit 2; }
	mkdir -p $(KEPT)
	$(reduce) keep $(tables) $(KEPT)/tables.tar.bz2
	cp $(work)/choices.tsv $(KEPT)
