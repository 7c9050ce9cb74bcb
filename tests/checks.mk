# checks.mk - runs CHECKS beside each other, called by tests/run.sh: parts of the command line (cli-PART),
# CUnit suites (suite-NAME, suite-NAME+NAME), install, browser, python.  What they print is recorded.
# What takes longest begins first.
LONGEST = suite-generate_bits suite-integrators cli-hostile cli-generate python cli-native suite-trend cli-documents \
          cli-resume cli-events cli-minimal browser install

all: $(filter $(CHECKS),$(LONGEST)) $(CHECKS)

RECORD = -@sh tests/record.sh $@
$(filter cli-%,$(CHECKS)): cli-%:
	$(RECORD) sh tests/cli/run.sh $(PROGRAM) $*
$(filter suite-%,$(CHECKS)): suite-%:
	$(RECORD) env $(RUN_SUITE) $(BUILD)/tests/suite $(SUITE_OPTIONS) $(subst +, ,$*)
install python: %:
	$(RECORD) sh tests/$@.sh "$(MAKE)" $(BUILD)
browser:
	$(RECORD) sh tests/browser/run.sh $(PROGRAM)

.PHONY: all $(CHECKS)
