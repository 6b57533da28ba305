# B of what the runs left. A changed rule comes here and goes no further.

fits := $(out)/fit
.PHONY: fits
reproduce: $(call files_of,$(campaign)) $(out)/costs.tsv fits

$(out)/costs.tsv: $(campaign:%=$(out)/%/checksums)
	@cd $(out) && for cost in */cost.tsv; do sed "1s/^/run\t/; 2s|^|$${cost%/*}\t|" $$cost; done | \
	  awk '!/^run/ || NR == 1' > $@.new
	@mv $@.new $@

# of FLOWS, TABLE: that table of all seeds of these flows, by its name in OUT.
of = $(foreach flow,$(1),$(patsubst %,%/$(2).tsv,$(filter $(flow)-seed%,$(runs))))

# What a fit is made of beside its tables.
$(fits)/.settings: FORCE
	$(call settings,$(BOOTSTRAP) $(runs))
$(fits)/.partition: FORCE
	$(call settings,$(PARTITION))
$(fits)/.scan: FORCE
	$(call settings,$(SCAN))

# fit NAME, TABLES, OPTIONS, SETTINGS: a rule, where there are tables.
fit = $(if $(2),$(call rule_of_fit,$(1),$(2),$(3),$(4)))
define rule_of_fit
fits: $(if $(filter sensitivity/%,$(1)),,$(fits)/$(1).tsv)
$(fits)/$(1).tsv: $(addprefix $(out)/,$(2)) $(addprefix $(fits)/,.settings $(4))
	@mkdir -p $$(@D)
	cd $(out) && $(bin)/grseg-fit $(2) --bootstrap $(BOOTSTRAP) $(3) --quiet -o fit/$(1).tsv
endef
by_rule := --partition $(PARTITION)
kinetic := --quantity kinetic
above_base := --heights 4dS:

# fits_of NAME, FLOWS: B by rule, and B_kappa.
define fits_of
$(call fit,$(1),$(call of,$(2),stress),$(by_rule),.partition)
$(call fit,$(1).kinetic,$(call of,$(2),kinetic),$(kinetic))
$(call fit,$(1).kinetic-above-base,$(call of,$(2),kinetic),$(kinetic) $(above_base))
endef
$(foreach flow,$(mixtures) $(slopes) $(control),$(eval $(call fits_of,$(flow),$(flow))))
all_slopes := $(SLOPES:%=phi0.45-s%)
$(eval $(call fits_of,mixtures,$(mixtures)))
$(eval $(call fits_of,slopes,$(all_slopes)))
$(eval $(call fit,mixtures.pressure,$(call of,$(mixtures),stress),$(by_rule) --component pressure,.partition))
$(eval $(call fit,mixtures.scan,$(call of,$(mixtures),stress),--scan $(SCAN),.scan))
$(eval $(call fit,mixtures.stock,$(call of,$(mixtures),stress),--partition stock))
$(eval $(call fit,$(control).random,$(call of,$(control),stress-random),$(by_rule),.partition))

# What B and B_kappa owe to the numbers that the paper does not give: other runs (VARIANTS), held against
# the same time of flow of the campaign's; and other ways to make tables of those.
base := phi0.45-s23
until := --end $(SENSITIVITY_DURATION)
two_rules := --partition size,half
base_of = $(foreach n,$(call seeds,$(SENSITIVITY_SEEDS)),$(base)-seed$(n)/$(1).tsv)
stress_tables := $(filter stress%,$(tables:.tsv=))
kinetic_tables := $(filter kinetic%,$(tables:.tsv=))
$(foreach table,$(stress_tables),$(eval $(call fit,sensitivity/$(table),$(call base_of,$(table)),$(two_rules) $(until))))
$(foreach table,$(kinetic_tables),$(eval $(call fit,sensitivity/$(table),$(call base_of,$(table)),$(kinetic) $(above_base) $(until))))
define fits_of_variant
$(call fit,sensitivity/stress.$(1),$(call of,$(base)-$(1),stress),$(two_rules))
$(call fit,sensitivity/kinetic.$(1),$(call of,$(base)-$(1),kinetic),$(kinetic) $(above_base))
endef
$(foreach variant,$(VARIANTS),$(eval $(call fits_of_variant,$(variant))))

sensitivity_fits := $(foreach table,stress kinetic,\
  $($(table)_tables:%=$(fits)/sensitivity/%.tsv) $(VARIANTS:%=$(fits)/sensitivity/$(table).%.tsv))
sensitivities: $(call files_of,$(varied)) $(fits)/sensitivities.tsv
$(fits)/sensitivities.tsv: $(sensitivity_fits)
	./sensitivities $(sensitivity_fits) > $@.new
	@mv $@.new $@
