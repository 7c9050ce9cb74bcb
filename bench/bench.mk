# bench.mk - the timed comparisons; a part of the Makefile.
#
#     make bench            all cases of bench/cases.txt, RUNS=7 processes each; build/bench.jsonl
#     make bench-sizes      what a step takes on chains of 4 to 256 coordinates; build/bench/sizes.jsonl
#     make bench-runs       runs of the program, cold and warm, and an ensemble of BENCH_MEMBERS (a million)
#                           members; build/bench/runs.jsonl
#     make bench-tolerances the time to an error under error control; build/bench/tolerances.jsonl; with
#                           HEYOKA_SOURCE=DIR heyoka, too
#     make bench-page       build/bench/report/index.html, of these, those that are missing made first
#     make bench-smoke      the same with next to no work: does it all build, run and agree?
#     make bench-solvers    the solver auto against the better of the two, 60 cases: some 10 s
#     make bench-versions   an observed step against one of version 0.4, in instructions: a minute
#     make bench-long       1e9 steps of the sleigh with statistics at every step: some 40 s
#     make bench-targets    how many of 200 drawn targets steering reaches, three systems: two hours;
#                           TARGETS=60 draws fewer
#     make bench-native     --native auto against off and on, 40 cases: half an hour of two processors
#
# Every program is built with the flags that made it fastest here: full optimisation for this
# machine without packing scalars into vectors, and for the others, which promise no bits, with
# contraction.  Peers that are not installed are left out.
BENCH        = $(BUILD)/bench
BENCH_FAST   = -O3 -march=native -fno-tree-slp-vectorize -fno-math-errno
BENCH_PEER   = -std=gnu11 -Wall -Wextra $(BENCH_FAST) -Iinclude -Ilib
BENCH_HAVE   = $(shell $(2) -fsyntax-only -include $(1) /dev/null 2>/dev/null && echo $(3))
BENCH_RK4    = boost/numeric/odeint/stepper/runge_kutta4.hpp
BENCH_CXX   ?= g++
BENCH_PEERS  = $(call BENCH_HAVE,gsl/gsl_odeiv2.h,$(CC) -x c,gsl) \
               $(call BENCH_HAVE,arkode/arkode_erkstep.h,$(CC) -x c,sundials) \
               $(call BENCH_HAVE,$(BENCH_RK4),$(BENCH_CXX) -x c++,odeint) \
               $(if $(shell command -v clang),$(BENCH_LINKS:%=clang-links-%)) $(if $(BENCH_PYTHON),python)
BENCH_LINKS  = 6 12 16 32
BENCH_PYTHON = $(shell for python in python3 /usr/bin/python3; do \
    $$python -c 'import cffi, ensurepip, numpy, setuptools' 2>/dev/null && echo $$python && break; done)
BENCH_HEADERS = $(wildcard bench/*.h bench/*.inc examples/*.h lib/kernel/*.h include/*.h)

$(BENCH)/lib/libdalembert.a: FORCE
	@$(MAKE) -s --no-print-directory BUILD=$(BENCH)/lib CFLAGS="-O3 -march=native" $@
$(BENCH)/dal: bench/dal.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) $(EXACT) -O3 -march=native -Iinclude $< \
	    $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/native: bench/native.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/tolerances: bench/tolerances.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
# heyoka 7 from its repository, where HEYOKA_SOURCE names it: C++23, LLVM 18 or later, Boost 1.85.
$(BENCH)/heyoka: $(wildcard bench/heyoka/*) $(BENCH_HEADERS)
	$(call SAY,cmake)cmake -S bench/heyoka -B $@.build -DHEYOKA_SOURCE="$(abspath $(HEYOKA_SOURCE))" \
	    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$(BENCH_CXX)" -DCMAKE_CXX_FLAGS=-march=native >$@.log
	@+cmake --build $@.build --target bench-heyoka >>$@.log
	@cp $@.build/bench-heyoka $@
$(BENCH)/rows: bench/rows.c $(BUILD)/tests/program.a $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -O2 -Iinclude -Icli $< $(BUILD)/tests/program.a $(STATIC) $(LIBS) -o $@
$(BENCH)/numbers: bench/numbers.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -O2 -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/statistics: bench/statistics.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/hand: bench/hand.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $< -lm -o $@
$(BENCH)/hand-own: bench/hand.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) -DHAND_OWN_SINCOS $< -lm -o $@
$(BENCH)/hand-implicit: bench/hand_implicit.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $< -lm -o $@
$(BENCH)/hand-implicit-own: bench/hand_implicit.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) -DHAND_OWN_SINCOS $< -lm -o $@
$(BENCH)/hand-implicit-compensated: bench/hand_implicit.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $(EXACT) -DHAND_OWN_SINCOS -DHAND_COMPENSATED $< -lm -o $@
$(BENCH)/hand-links-%: bench/hand_implicit.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) -DHAND_LINKS=$* $< -lm -o $@
$(BENCH)/hand-links-compensated-%: bench/hand_implicit.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $(EXACT) -DHAND_OWN_SINCOS -DHAND_COMPENSATED -DHAND_LINKS=$* $< -lm -o $@
$(BENCH)/clang-links-%: bench/hand_implicit.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)clang $(BENCH_PEER) -ffp-contract=fast -DHAND_LINKS=$* $< -lm -o $@
$(BENCH)/gsl: bench/gsl.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $< -lgsl -lgslcblas -lm -o $@
$(BENCH)/sundials: bench/sundials.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $< -lsundials_arkode -lsundials_nvecserial -lm -o $@
$(BENCH)/odeint: bench/odeint.cpp $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,c++)$(BENCH_CXX) -std=gnu++17 -Wall -Wextra -Wno-psabi -Wno-ignored-attributes $(BENCH_FAST) \
	    -Iinclude -Ilib $< -o $@
# The package of python/ with this library, in an environment of its own.
$(BENCH)/python: bench/steps.py $(BENCH)/lib/libdalembert.a $(wildcard python/*.* python/dalembert/*)
	@$(BENCH_PYTHON) -m venv --system-site-packages $(BENCH)/V
	@DALEMBERT_BUILD=$(realpath $(BENCH)/lib) $(BENCH)/V/bin/pip install -q --force-reinstall \
	    --no-build-isolation --no-deps ./python
	@printf '#!/bin/sh\nexec $(BENCH)/V/bin/python $< "$$@"\n' >$@ && chmod +x $@

$(BENCH)/peak: bench/peak.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) -Wno-psabi $< -lm -o $@

# gen.METHOD.SPACE.SYSTEM.LANES, as many as the cases name; a system of bench/systems or a built-in one.
BENCH_GEN  = $(shell grep -o 'gen\.[^ |]*' bench/cases.txt | sort -u)
BENCH_WORD = $(word $(1),$(subst ., ,$*))
$(BENCH)/lib/dalembert: FORCE
	@$(MAKE) -s --no-print-directory BUILD=$(BENCH)/lib CFLAGS="-O3 -march=native" $@
$(BENCH)/gen.%.c: $(BENCH)/lib/dalembert
	@$< generate $(or $(wildcard bench/systems/$(call BENCH_WORD,3).yaml),$(call BENCH_WORD,3)) --integrator $(call BENCH_WORD,1) \
	    --space $(call BENCH_WORD,2) --lanes $(call BENCH_WORD,4) --prefix gen -o $@
$(BENCH)/gen.%: $(BENCH)/gen.%.c bench/gen.c bench/bench.h
	$(call SAY,cc)$(CC) -std=c11 -D_POSIX_C_SOURCE=200809L $(BENCH_FAST) $(EXACT) -Wno-psabi \
	    -include $< bench/gen.c -lm -o $@

# The page of the results, one of the pages of `dalembert report`.
$(BENCH)/page: bench/page.c $(BUILD)/tests/program.a $(STATIC)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(ALL) -Icli $(LDFLAGS) $^ $(LIBS) -o $@

bench-programs: $(BENCH)/dal $(BENCH)/rows $(BENCH)/numbers $(BENCH)/native $(BENCH)/statistics $(BENCH)/hand $(BENCH)/hand-own $(BENCH)/hand-implicit \
    $(BENCH)/hand-implicit-own $(BENCH)/hand-implicit-compensated $(BENCH)/peak \
    $(BENCH_LINKS:%=$(BENCH)/hand-links-%) $(BENCH_LINKS:%=$(BENCH)/hand-links-compensated-%)
	@for gen in $(BENCH_GEN); do $(MAKE) -s --no-print-directory $(BENCH)/$$gen || exit 1; done
	@for peer in $(BENCH_PEERS); do $(MAKE) -s --no-print-directory $(BENCH)/$$peer || exit 1; done
# The results, measured where they are missing, one after the other; bench, bench-sizes and bench-runs
# measure them again.
define BENCH_CASES
@CC="$(CC)" sh bench/run.sh bench/cases.txt $(BENCH) $(BUILD)/bench.jsonl
endef
define BENCH_SIZES
@sh bench/sizes.sh >$(BENCH)/sizes.txt
@CC="$(CC)" RUNS=3 sh bench/run.sh $(BENCH)/sizes.txt $(BENCH) $(BENCH)/sizes.jsonl
endef
define BENCH_TOLERANCES
@sh bench/tolerances.sh $(BENCH) $(if $(HEYOKA_SOURCE),heyoka) >$(BENCH)/tolerances.new
@mv $(BENCH)/tolerances.new $(BENCH)/tolerances.txt
@CC="$(CC)" sh bench/run.sh $(BENCH)/tolerances.txt $(BENCH) $(BENCH)/tolerances.jsonl
endef
define BENCH_RUNS
@mkdir -p $(BENCH)
@CC="$(CC)" sh bench/machine.sh 2 >$(BENCH)/runs.new
@python3 bench/native_auto.py --few $(PROGRAM) $(BENCH)/runs.new
@python3 bench/ensemble.py $(PROGRAM) $(BENCH) $(BENCH)/runs.new
@mv $(BENCH)/runs.new $(BENCH)/runs.jsonl
endef
bench: bench-programs
	$(BENCH_CASES)
bench-sizes: $(BENCH)/dal
	$(BENCH_SIZES)
BENCH_ERROR = $(BENCH)/tolerances $(BENCH)/hand $(if $(HEYOKA_SOURCE),$(BENCH)/heyoka)
bench-tolerances: $(BENCH_ERROR)
	$(BENCH_TOLERANCES)
bench-runs: $(PROGRAM) $(BENCH)/dal
	$(BENCH_RUNS)
$(BUILD)/bench.jsonl: | bench-programs
	$(BENCH_CASES)
$(BENCH)/sizes.jsonl: | $(BENCH)/dal $(BUILD)/bench.jsonl
	$(BENCH_SIZES)
$(BENCH)/tolerances.jsonl: | $(BENCH_ERROR) $(BENCH)/sizes.jsonl
	$(BENCH_TOLERANCES)
$(BENCH)/runs.jsonl: | $(PROGRAM) $(BENCH)/dal $(BENCH)/tolerances.jsonl
	$(BENCH_RUNS)
BENCH_RESULTS = $(BUILD)/bench.jsonl $(BENCH)/sizes.jsonl $(BENCH)/tolerances.jsonl $(BENCH)/runs.jsonl
bench-page: $(BENCH)/page $(BENCH_RESULTS)
	@$< $(BENCH) $(BENCH_RESULTS)
bench-smoke: bench-programs $(BENCH_ERROR)
	@RUNS=1 BENCH_MS=0 sh bench/run.sh bench/cases.txt $(BENCH) $(BENCH)/smoke.jsonl
	@sh bench/tolerances.sh $(BENCH) >$(BENCH)/smoke.txt
	@RUNS=1 BENCH_MS=0 sh bench/run.sh $(BENCH)/smoke.txt $(BENCH) $(BENCH)/smoke.jsonl
.PHONY: bench bench-page bench-programs bench-runs bench-sizes bench-smoke bench-tolerances
.PRECIOUS: $(BENCH)/gen.%.c

$(BENCH)/solvers: bench/solvers.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -O2 -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
bench-solvers: $(BENCH)/solvers
	@$< tape
.PHONY: bench-solvers

$(BENCH)/targets: bench/targets.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -O2 -Iinclude -Ilib $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
TARGETS = 200
bench-targets: $(BENCH)/targets
	@$< $(TARGETS) chaplygin-sleigh constraint
	@$< $(TARGETS) bench/systems/robot-with-motors.yaml controls
	@$< $(TARGETS) examples/actuated-snakeboard.yaml controls psi phi
.PHONY: bench-targets

bench-versions: $(PROGRAM)
	@sh bench/versions.sh $(PROGRAM) $(BENCH)/versions
.PHONY: bench-versions

bench-long: $(PROGRAM)
	@mkdir -p $(BENCH)
	$(if $(wildcard /usr/bin/time),/usr/bin/time -f "%e s; at most %M KiB of memory") $(PROGRAM) run \
	    chaplygin-sleigh --integrator rk4 --space physical --step 0.01 --time 1e7 --native on \
	    --output $(BENCH)/long --force --summary
.PHONY: bench-long

bench-native: $(PROGRAM)
	@python3 bench/native_auto.py $(PROGRAM)
.PHONY: bench-native
