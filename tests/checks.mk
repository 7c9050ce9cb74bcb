# checks.mk - runs CHECKS beside each other, called by tests/run.sh: parts of the command line (cli-PART),
# CUnit suites (suite-NAME, suite-NAME+NAME), install, browser, python.  What they print is recorded.
# What takes longest begins first.
LONGEST = python cli-generate cli-minimal suite-generate_bits cli-native cli-calls suite-integrators cli-hostile \
          cli-documents cli-study cli-events suite-trend install cli-memory cli-options suite-adaptive cli-study_shard \
          suite-batch browser cli-resume

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
