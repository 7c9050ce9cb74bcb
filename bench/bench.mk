# bench.mk - the timed comparisons; a part of the Makefile.
#
#     make bench            all cases of bench/cases.txt, RUNS=7 processes each; build/bench.jsonl
#     make bench-smoke      the same with next to no work: does it all build, run and agree?
#     make bench-long       1e9 steps of the sleigh with statistics at every step: some 40 s
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
               $(if $(BENCH_PYTHON),python)
BENCH_PYTHON = $(shell for python in python3 /usr/bin/python3; do \
    $$python -c 'import cffi, ensurepip, numpy, setuptools' 2>/dev/null && echo $$python && break; done)
BENCH_HEADERS = $(wildcard bench/*.h bench/*.inc examples/*.h lib/kernel/*.h) include/dalembert.h

$(BENCH)/lib/libdalembert.a: FORCE
	@$(MAKE) -s --no-print-directory BUILD=$(BENCH)/lib CFLAGS="-O3 -march=native" $@
$(BENCH)/dal: bench/dal.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) $(EXACT) -O3 -march=native -Iinclude $< \
	    $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/native: bench/native.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/rows: bench/rows.c $(BUILD)/tests/program.a $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -O2 -Iinclude -Icli $< $(BUILD)/tests/program.a $(STATIC) $(LIBS) -o $@
$(BENCH)/statistics: bench/statistics.c $(BENCH)/lib/libdalembert.a $(BENCH_HEADERS)
	$(call SAY,cc)$(CC) -std=c11 $(WARN) -Iinclude $< $(BENCH)/lib/libdalembert.a $(LIBS) -o $@
$(BENCH)/hand: bench/hand.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) $< -lm -o $@
$(BENCH)/hand-own: bench/hand.c $(BENCH_HEADERS)
	@mkdir -p $(@D)
	$(call SAY,cc)$(CC) $(BENCH_PEER) -DHAND_OWN_SINCOS $< -lm -o $@
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

# gen.METHOD.SPACE.SYSTEM.LANES, as many as the cases name.
BENCH_GEN  = $(shell grep -o 'gen\.[^ |]*' bench/cases.txt | sort -u)
BENCH_WORD = $(word $(1),$(subst ., ,$*))
$(BENCH)/lib/dalembert: FORCE
	@$(MAKE) -s --no-print-directory BUILD=$(BENCH)/lib CFLAGS="-O3 -march=native" $@
$(BENCH)/gen.%.c: $(BENCH)/lib/dalembert
	@$< generate bench/systems/$(call BENCH_WORD,3).yaml --integrator $(call BENCH_WORD,1) \
	    --space $(call BENCH_WORD,2) --lanes $(call BENCH_WORD,4) --prefix gen -o $@
$(BENCH)/gen.%: $(BENCH)/gen.%.c bench/gen.c bench/bench.h
	$(call SAY,cc)$(CC) -std=c11 -D_POSIX_C_SOURCE=200809L $(BENCH_FAST) $(EXACT) -Wno-psabi \
	    -include $< bench/gen.c -lm -o $@

bench-programs: $(BENCH)/dal $(BENCH)/rows $(BENCH)/native $(BENCH)/statistics $(BENCH)/hand $(BENCH)/hand-own $(BENCH)/peak
	@for gen in $(BENCH_GEN); do $(MAKE) -s --no-print-directory $(BENCH)/$$gen || exit 1; done
	@for peer in $(BENCH_PEERS); do $(MAKE) -s --no-print-directory $(BENCH)/$$peer || exit 1; done
bench: bench-programs
	@sh bench/run.sh bench/cases.txt $(BENCH) $(BUILD)/bench.jsonl
bench-smoke: bench-programs
	@RUNS=1 BENCH_MS=0 sh bench/run.sh bench/cases.txt $(BENCH) $(BENCH)/smoke.jsonl
.PHONY: bench bench-programs bench-smoke
.PRECIOUS: $(BENCH)/gen.%.c

bench-long: $(PROGRAM)
	@mkdir -p $(BENCH)
	$(if $(wildcard /usr/bin/time),/usr/bin/time -f "%e s; at most %M KiB of memory") $(PROGRAM) run \
	    chaplygin-sleigh --integrator rk4 --space physical --step 0.01 --time 1e7 --native on \
	    --output $(BENCH)/long --force --summary
.PHONY: bench-long

bench-native: $(PROGRAM)
	@python3 bench/native_auto.py $(PROGRAM)
.PHONY: bench-native
