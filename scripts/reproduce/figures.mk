# Every figure and number of the paper beside ours, of what the runs left: OUT/reproduction.md and OUT/figures
# (FIGURES=no: not).
FIGURES ?= yes
ifeq ($(FIGURES),yes)
reproduce: $(out)/reproduction.md
endif
$(out)/reproduction.md: $(campaign:%=$(out)/%/checksums)
	cp ../../docs/reproduction.md $@.new
	+$(MAKE) --no-print-directory -f document.mk reproduction.md TABLES=$(out) WORK=$(out)/figures BIN=$(bin) \
	  DOCUMENT=$@.new PICTURES=$(out)/figures/reproduction BOOTSTRAP=$(BOOTSTRAP)
	mv $@.new $@
