# dalembert
#
#     make                  build/dalembert, build/libdalembert.a, build/libdalembert.so
#     make help             this list
#     make install          to PREFIX (/usr/local), below DESTDIR; uninstall removes it (docs/installation.md)
#     make dist             build/dalembert-VERSION.tar.gz, of the last commit
#     make MINIMAL=1        build/minimal/libdalembert.a, for small targets; INTEGRATORS="rk4 gauss4+project": with these alone
#     make mpi              build/dalembert-mpi, where there is Open MPI
#     make clean            remove build/
#
#     make check            all tests, as many beside each other as -j says; the CUnit summary comes last
#     make check-python     the package of python/, where Python has cffi, numpy and pytest; a part of check
#     make check-sanitize   the tests under the address and undefined-behaviour sanitizers
#     make check-valgrind   the CUnit suites under valgrind
#     make check-browser    the report's pages in headless Chromium; a part of check
#     make check-dist       the tarball: it builds, passes a part of its tests and installs
#     make check-packages   the packages of debian/: they build, satisfy lintian and work in a new Debian
#     make check-cross      for aarch64 by Debian's compiler: every method and some suites under qemu-user
#     make check-kill       runs killed at KILLS random moments and resumed
#     make check-bits       generated code against the interpreter, all cases, hours; BITS_JOBS at a time
#     make units            every built-in system in the units drawn by UNITS (1 2 3 4)
#     make trends           how often trends are right: SERIES (200) of each kind, length and noise
#     make lint             the rules of the source, and the tools that check C and shell
#     make fuzz             each fuzz target for FUZZ_SECONDS
#     make mutants          whether the tests notice COUNT faults, drawn by SEED, planted in MODULE
#     make bench            the timed comparisons of bench/cases.txt; bench-page, -tolerances, ...
#     make gallery          the pictures of the README and of docs/
#     make references       the parts of docs/ that the program prints; CHOOSING=1: and its study's tables
#     make docs             build/site: docs/ and the reference of the public headers as web pages
#
# BUILD=dir puts everything elsewhere; CFLAGS=-O3\ -march=native changes the speed, never a bit;
# V=1 shows the commands.  Unless there is a -j, one job more than there are processors runs: some wait.
BUILD        ?= $(if $(MINIMAL),build/minimal,build)
PREFIX       ?= /usr/local
CC           ?= cc
CFLAGS       ?= $(if $(MINIMAL),-Oz,-O2 -g)
FUZZ_SECONDS ?= 10
FUZZ_CC      ?= clang

# A -j of the command line has precedence over this one, though GNU Make 4.3 does not show it here.
# Without clean: other targets have to wait for that.
ifeq ($(MAKELEVEL),0)
ifeq ($(filter -j% --jobs%,$(MAKEFLAGS) $(shell echo "$$MAKEFLAGS"))$(filter clean,$(MAKECMDGOALS)),)
MAKEFLAGS += -j$(shell expr 1 + $$(nproc 2>/dev/null || echo 1))
endif
endif

WARN = -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla \
       -Wpointer-arith -Wwrite-strings -Wno-psabi
# No contraction and no reassociation: the bits of a trajectory are promised.
EXACT = -ffp-contract=off -fno-math-errno
ALL   = -std=c11 -D_POSIX_C_SOURCE=200809L $(WARN) $(EXACT) -fPIC -pthread -Iinclude $(PLACE) \
        -I$(BUILD)/generated $(SMALL) $(CPPFLAGS) $(CFLAGS)
PLACE = -Ilib
# An option, where the compiler has it.
KNOWN = $(shell $(CC) -Werror $1 -S -x c /dev/null -o /dev/null 2>/dev/null && echo '$1')
LIBS  = -lyaml -lm -pthread

VERSION := $(shell awk '/define DAL_VERSION_(MAJOR|MINOR|PATCH) / { printf "%s%s", dot, $$3; dot = "." }' include/dalembert.h)
# Before 1.0 a minor version may change the interface.
SONAME  := libdalembert.so.$(basename $(VERSION))

# Sources over num - files named *_wide.c, and every integrator - are compiled once per variant: a
# number of lanes and an instruction set, chosen when a batch is made.  What each gains is in
# docs/performance.md.  x1 is what others may call by name.  x1_QUAD has quad precision
# (lib/kernel/quad.h), which no machine has for an instruction set: it is never chosen for speed.
VARIANTS        = $(if $(MINIMAL),x1,x1 x1_QUAD $(or $(VARIANTS_$(MACHINE)),x4))
VARIANTS_x86_64 = x1_AVX2 x4_AVX2 x8_AVX512
FLAGS_AVX2      = -mavx2 -mfma
FLAGS_AVX512    = -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512
FLAGS_QUAD        = -DDAL_NUM_QUAD
INSTRUCTIONS    = QUAD AVX2 AVX512
MACHINE        := $(firstword $(subst -, ,$(shell $(CC) -dumpmachine)))
lanes           = $(patsubst x%,%,$(firstword $(subst _, ,$1)))
instructions    = $(or $(word 2,$(subst _, ,$1)),BASE)

# What MINIMAL leaves out, which dalembert.h states; and how it becomes small.
ifdef MINIMAL
LEFT_OUT = $(filter-out lib/core/% lib/expr/% lib/model/% lib/run/%,$(wildcard lib/*/*.c)) lib/core/buffer.c lib/core/svd.c \
           lib/expr/emit.c lib/expr/taylor_emit.c lib/model/branches.c lib/run/batch.c \
           lib/run/ensemble.c lib/run/quad.c
SMALL   := -fPIE -ffunction-sections -fdata-sections -fno-asynchronous-unwind-tables $(call KNOWN,-fno-caller-saves) \
           -DDAL_MINIMAL -DDAL_LINKED -Wno-override-init -Wno-missing-prototypes
else
EMBEDDED_IN_LIBRARY = systems sources trend_tables
endif
# Integrators and modifiers by their names in integrators.def, which INTEGRATORS may join by +.
METHODS    = $(subst -,_,$(subst +, ,$(INTEGRATORS)))
METHOD_DEF = $(BUILD)/generated/integrators.def

WIDE_SRC   = $(filter-out $(LEFT_OUT),$(wildcard lib/*/*_wide.c))
METHOD_SRC = $(or $(sort $(foreach name,$(METHODS),$(shell sed -n \
             's/^INTEGRATOR.$(name), \(.*\).$$/integrators\/\1.c/p' integrators/integrators.def))),$(wildcard integrators/*.c))
LIB_SRC    = $(filter-out $(LEFT_OUT) $(WIDE_SRC),$(wildcard lib/*/*.c))
LIB_OBJ    = $(LIB_SRC:%.c=$(BUILD)/%.o) $(EMBEDDED_IN_LIBRARY:%=$(BUILD)/generated/%.o) \
             $(call WIDE,$(VARIANTS),$(WIDE_SRC) $(METHOD_SRC))
CLI_SRC    = $(filter-out cli/mpi/%,$(wildcard cli/*/*.c cli/commands/*/*.c))
EMBEDDED   = study report_style report_script template
CLI_OBJ    = $(CLI_SRC:%.c=$(BUILD)/%.o) $(EMBEDDED:%=$(BUILD)/generated/%.o)
WIDE       = $(foreach variant,$1,$(2:%.c=$(BUILD)/%_$(variant).o))

SUITES    = $(patsubst tests/test_%.c,%,$(filter-out %_wide.c,$(wildcard tests/test_*.c)))
FUZZERS   = $(patsubst tests/%.c,%,$(wildcard tests/fuzz_*.c))
TEST_SRC  = $(filter-out tests/fuzz_% %_wide.c,$(wildcard tests/*.c))
TEST_OBJ  = $(TEST_SRC:%.c=$(BUILD)/%.o) $(call WIDE,$(VARIANTS),$(wildcard tests/*_wide.c))
TEST_LIBS = -lcunit -lmpfr -lgmp -ljansson

PROGRAM = $(BUILD)/dalembert
STATIC  = $(BUILD)/libdalembert.a
SHARED  = $(BUILD)/libdalembert.so
KERNEL  = $(BUILD)/generated/dalembert_kernel.h
SYSTEMS = $(BUILD)/generated/systems.c
MANUAL  = $(BUILD)/dalembert.1
COMPLETION = $(BUILD)/dalembert.bash

SAY = $(if $(V),,@echo '  $1 $@';)

ifdef MINIMAL
all: $(STATIC) $(KERNEL)
else
all: $(PROGRAM) $(STATIC) $(SHARED) $(KERNEL) $(MANUAL) $(COMPLETION)
endif

help:
	@sed -n '3,/^BUILD/{/^BUILD/q; s/^# \{0,1\}//p;}' $(firstword $(MAKEFILE_LIST))

# Before the first object of a build.
START = $(BUILD)/generated/started
$(START):
	@mkdir -p $(@D)
	@echo "Building dalembert in $(BUILD): up to a minute of processor time."
	@touch $@

# ---- objects ---------------------------------------------------------------------------------

define COMPILE
@mkdir -p $(@D)
$(call SAY,cc)$(CC) $(ALL) $(VARIANT) -MMD -MP -c $< -o $@
endef

define COMPILE_VARIANT
$(BUILD)/%_$1.o: VARIANT = $(if $(filter x1,$1),,-DDAL_VARIANT_NAME=$1) -DDAL_LINKED -DDAL_LANES=$(lanes) $(FLAGS_$(instructions))
$(BUILD)/%_$1.o: %.c ; $$(COMPILE)
endef
$(foreach variant,$(VARIANTS),$(eval $(call COMPILE_VARIANT,$(variant))))
$(BUILD)/%.o: %.c ; $(COMPILE)
$(LIB_OBJ) $(TEST_OBJ) $(FUZZERS:%=$(BUILD)/tests/%.o): | $(BUILD)/generated/variants.h
# Where the operations of the interpreter begin decides how fast it is, and moves with the code before it.
ALIGNED := $(if $(MINIMAL),,$(call KNOWN,-falign-labels=32))
$(BUILD)/lib/expr/tape_wide_%.o: ALL += $(ALIGNED)
$(BUILD)/lib/run/registry.o: $(METHOD_DEF)
$(LIB_OBJ) $(CLI_OBJ) $(TEST_OBJ): | $(START)

$(STATIC): $(LIB_OBJ)
	$(call SAY,ar)rm -f $@; $(AR) rcs $@ $^

$(SHARED).$(VERSION): $(LIB_OBJ) tools/exports.map
	$(call SAY,ld)$(CC) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(SONAME) \
	    -Wl,--version-script=tools/exports.map $(LIB_OBJ) $(LIBS) -o $@
$(SHARED): $(SHARED).$(VERSION)
	@ln -sf $(<F) $(BUILD)/$(SONAME)
	@ln -sf $(SONAME) $@

# Where it was built is none of the flags that manifests name.
$(BUILD)/cli/run/manifest.o: ALL += -DCLI_FLAGS='"$(strip $(EXACT) $(filter-out -ffile-prefix-map=%,$(CFLAGS)))"'
$(PROGRAM): $(CLI_OBJ) $(STATIC)
	$(call SAY,ld)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(LIBS) -o $@

# Studies and ensembles on the processes of a cluster, by Open MPI: everything of the program but its main.
MPI_PROGRAM = $(BUILD)/dalembert-mpi
MPI_OBJ     = $(patsubst %.c,$(BUILD)/%.o,$(wildcard cli/mpi/*.c))
MPICC      ?= mpicc
MPI_CFLAGS  = $(patsubst -I%,-isystem%,$(shell $(MPICC) --showme:compile))
mpi: $(MPI_PROGRAM)
$(MPI_OBJ): ALL += $(MPI_CFLAGS)
$(MPI_PROGRAM): $(MPI_OBJ) $(filter-out %/commands/main.o,$(CLI_OBJ)) $(STATIC)
	$(call SAY,ld)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(LIBS) \
	    $(shell $(MPICC) --showme:link) -o $@

# The program knows the library by its public headers alone.
$(CLI_OBJ) $(MPI_OBJ): PLACE = -Icli

# ---- generated texts -------------------------------------------------------------------------

# The library contains the systems.
$(SYSTEMS): tools/embed-systems.sh $(wildcard systems/*.yaml) systems
	@mkdir -p $(@D)
	$(call SAY,sh)sh tools/embed-systems.sh $(addsuffix .yaml,$(sort $(basename $(wildcard systems/*.yaml)))) >$@.tmp && mv $@.tmp $@
# So do the kernel and the integrators, for generated files.
SOURCES = $(wildcard lib/kernel/*.h) $(addprefix lib/codegen/,dispatch.inc stepper.inc interface.inc observables.inc) \
          $(wildcard integrators/*.c)
$(BUILD)/generated/sources.c: tools/embed-sources.sh $(SOURCES)
	@mkdir -p $(@D)
	sh tools/embed-sources.sh $(SOURCES) >$@.tmp && mv $@.tmp $@
# Shapes and noises that trends are made of, by a program that runs here.
HOST_CC ?= cc
$(BUILD)/generated/trend_tables.c: tools/trend-tables.c lib/statistics/trend_tables.h
	@mkdir -p $(@D)
	$(call SAY,cc)$(HOST_CC) -std=c11 -O2 -Ilib $< -lm -o $(@D)/trend-tables
	$(@D)/trend-tables >$@.tmp && mv $@.tmp $@
PAGE_SCRIPTS = $(addprefix cli/report/,report_elements.js report_charts.js report_motion.js report.js)
# Texts that are parts of the program: the built-in study, style sheet and script of reports, a new system.
define EMBED
$(BUILD)/generated/$1.c: tools/embed-text.sh $3
	@mkdir -p $$(@D)
	sh tools/embed-text.sh $2 $3 >$$@.tmp && mv $$@.tmp $$@
endef
$(eval $(call EMBED,study,study_builtin_text,bench/studies/canonical-drift.yaml))
$(eval $(call EMBED,report_style,report_style,cli/report/report.css))
$(eval $(call EMBED,report_script,report_script,$(PAGE_SCRIPTS)))
$(eval $(call EMBED,template,system_template,cli/commands/template.yaml))
$(BUILD)/generated/%.o: $(BUILD)/generated/%.c ; $(COMPILE)

# The integrators of the library: all, unless INTEGRATORS names some.
$(METHOD_DEF): integrators/integrators.def FORCE
	@mkdir -p $(@D)
	@for name in $(METHODS); do grep -q "^INTEGRATOR($$name, " $< || \
	    { echo "INTEGRATORS: '$$name' is not in $<" >&2; exit 1; }; done
	@grep $(or $(METHODS:%=-e '^INTEGRATOR.%, '),.) $< >$@.tmp
	@if cmp -s $@.tmp $@; then rm $@.tmp; else mv $@.tmp $@; fi
# The lists of variants and of instruction sets for lib/core/machine.h.
$(BUILD)/generated/variants.h: Makefile
	@mkdir -p $(@D)
	@{ echo '#define DAL__HAS_QUAD $(if $(filter x1_QUAD,$(VARIANTS)),1,0)'; \
	    printf '#define DAL__INSTRUCTIONS_LIST(X)'; \
	    printf ' X(%s NULL)' 'BASE,' $(foreach set,$(INSTRUCTIONS),'$(set),$(FLAGS_$(set):%= "%",)'); \
	    echo; \
	    printf '#define DAL__VARIANT_LIST(X, name)'; \
	    printf '%s' $(foreach variant,$(filter-out x1,$(VARIANTS)),\
	        ' X(name, $(variant), $(call lanes,$(variant)), $(call instructions,$(variant)))'); echo; } >$@

# What an integrator outside the tree includes: one file that needs no other.
$(KERNEL): tools/amalgamate.sh include/dalembert_kernel.h $(wildcard include/*.h lib/kernel/*.h)
	@mkdir -p $(@D)
	$(call SAY,sh)sh tools/amalgamate.sh include/dalembert_kernel.h >$@.tmp && mv $@.tmp $@

# The program describes its commands itself.  Where it cannot run here, HOST_PROGRAM is one that can.
HOST_PROGRAM ?= $(PROGRAM)
REFERENCE     = $(BUILD)/generated/commands.md
$(REFERENCE): $(PROGRAM)
	$(call SAY,md)$(HOST_PROGRAM) help --markdown >$@.tmp && mv $@.tmp $@
$(MANUAL): tools/manual.awk $(REFERENCE) man/dalembert.1.in
	$(call SAY,awk)awk -v version=$(VERSION) -v commands=$(REFERENCE) -f $< man/dalembert.1.in >$@.tmp && mv $@.tmp $@
$(COMPLETION): tools/completion.awk $(REFERENCE)
	$(call SAY,awk)awk -f $^ >$@.tmp && mv $@.tmp $@

# The test suites there are.  The list changes with the files, so it is made in every run;
# suites.h, which declares them, goes before every test source.
$(BUILD)/generated/suites.h: FORCE
	@mkdir -p $(@D)
	@{ for s in $(SUITES); do echo "void suite_$$s(void);"; done; \
	    printf '#define SUITE_LIST(X)'; for s in $(SUITES); do printf ' X(%s)' $$s; done; \
	    echo; } >$@.tmp
	@if cmp -s $@.tmp $@; then rm $@.tmp; else mv $@.tmp $@; fi
$(TEST_OBJ): $(BUILD)/generated/suites.h
$(TEST_OBJ): ALL += -include suites.h -Icli

# The public functions, as lists FUNCTIONS_dalembert(X): each has a test of its arguments.
$(BUILD)/generated/functions.h: tools/header-functions.awk $(wildcard include/*.h)
	@mkdir -p $(@D)
	@awk -f tools/header-functions.awk include/dalembert.h include/dalembert_[!k]*.h >$@.tmp && mv $@.tmp $@
$(BUILD)/tests/test_null.o $(BUILD)/tests/test_null_measure.o: $(BUILD)/generated/functions.h

# ---- tests -----------------------------------------------------------------------------------

# Allocation goes through tests/allocation.c, which fails on demand and counts blocks; graphs of formulas are as small
# as tests/test_full_graph.c wants them.
WRAPPED = malloc calloc realloc aligned_alloc free yaml_parser_initialize yaml_parser_parse dal__graph_create
# Of the program the tests use what they call.
$(BUILD)/tests/program.a: $(filter-out %/commands/main.o,$(CLI_OBJ))
	@mkdir -p $(@D)
	$(call SAY,ar)rm -f $@; $(AR) rcs $@ $^
$(BUILD)/tests/suite: $(TEST_OBJ) $(BUILD)/tests/program.a $(STATIC)
	$(call SAY,ld)$(CC) $(CFLAGS) $(LDFLAGS) $(WRAPPED:%=-Wl,--wrap=%) \
	    $^ $(LIBS) $(OPENMP) $(TEST_LIBS) -o $@

# The reader of JSON alone, for a comparison with Python's.
$(BUILD)/tests/read_json: tests/cli/read_json.c $(BUILD)/tests/program.a $(STATIC)
	$(call SAY,cc)$(CC) $(ALL) -Icli $(LDFLAGS) $^ $(LIBS) -o $@

# Built-in systems in other units, as files.
$(BUILD)/tests/change_units: tests/cli/change_units.c $(STATIC)
	$(call SAY,cc)$(CC) $(ALL) $(LDFLAGS) $^ $(LIBS) -o $@

# A locale with a decimal comma; where there is none the tests that want one say so.  (Not under
# the leak checkers: with LOCPATH the C library's newlocale leaks.)
$(BUILD)/locale:
	@mkdir -p $@
	-@localedef -f UTF-8 -i de_DE $@/de_DE.UTF-8 2>/dev/null
RUN_SUITE = LOCPATH=$(BUILD)/locale

HAS_MPI = $(shell command -v $(MPICC) >/dev/null && echo $(MPI_PROGRAM))
# What there is to check (tests/checks.mk), in the order in which results are printed; all of it is made
# before.  SUITE has suites, all others being left out, and options of the suites.
PARTS  = $(patsubst tests/cli/%_cases.sh,%,$(wildcard tests/cli/*_cases.sh))
CHECKS = $(PARTS:%=cli-%) install browser python $(patsubst %,suite-%,$(or $(filter-out --%,$(SUITE)),$(SUITES)))
check: all $(HAS_MPI) $(BUILD)/tests/suite $(BUILD)/tests/read_json \
       $(BUILD)/tests/change_units $(BUILD)/bench/page $(BUILD)/locale
	@CC="$(CC)" CFLAGS="$(CFLAGS)" BUILD="$(BUILD)" PROGRAM="$(PROGRAM)" RUN_SUITE="$(RUN_SUITE)" \
	    SUITE_OPTIONS="$(filter --%,$(SUITE))" sh tests/run.sh "$(MAKE)" $(CHECKS)

check-python: all
	@CC="$(CC)" CFLAGS="$(CFLAGS)" sh tests/python.sh "$(MAKE)" $(BUILD)

check-browser: all $(BUILD)/bench/page
	@sh tests/browser/run.sh $(PROGRAM)

# One lane with other instructions and eight lanes are the sources of one and of four lanes, and would be a
# quarter of this build.  At a fixed address the program starts in three quarters of the time: it has fewer
# addresses to write.
CHECKED = -O1 -g1 -fno-omit-frame-pointer -fno-sanitize-recover=all -fsanitize-undefined-trap-on-error
# Undefined behaviour traps, and the address sanitizer prints where.  Without the last word of CHECKED there are words
# for it, with which the program is more than twice as large, and its start takes nearly twice as long.
check-sanitize:
	ASAN_OPTIONS="$${ASAN_OPTIONS:+$$ASAN_OPTIONS:}handle_sigill=1" \
	$(MAKE) BUILD=$(BUILD)/sanitize CFLAGS="$(CHECKED) -fsanitize=address,undefined" \
	    LDFLAGS="-no-pie $(LDFLAGS)" VARIANTS="$(filter-out x1_AVX2 %_AVX512,$(VARIANTS))" RUN_SUITE= check

# Not a part of check: it builds everything once more.
check-dist:
	@CC="$(CC)" CFLAGS="$(CFLAGS)" sh tests/dist.sh "$(MAKE)" $(BUILD)

# Not a part of check, either, and as root or with user namespaces: a new Debian by mmdebstrap.
check-packages:
	@sh tests/packages.sh "$(MAKE)" $(BUILD)

# Nor is this: everything for aarch64, under qemu-user.  SUITE names other suites.
CROSS_SUITES = algebra checkpoints closed_forms decimal elementary end_states generate_native literature parameter_bits \
               quad restricted run tape taylor
check-cross: all
	@CC="$(CC)" CFLAGS="$(CFLAGS)" SUITES="$(or $(SUITE),$(CROSS_SUITES))" sh tests/cross.sh "$(MAKE)" $(BUILD)

KILLS ?= 1000
check-kill: all
	@CALLS=1 KILLS=$(KILLS) sh tests/cli/run.sh $(PROGRAM) kill

# build/tests/suite --bits 3/500 compares a five-hundredth of it.  With BITS_BUILDS=1 each case meets
# one of the 12 builds: every method on every system, within an hour.
BITS_JOBS   ?= $(shell nproc)
BITS_BUILDS ?= 12
check-bits: $(BUILD)/tests/suite
	@seq $(BITS_JOBS) | xargs -P $(BITS_JOBS) -I{} $< --bits {}/$(BITS_JOBS)/$(BITS_BUILDS)

# Every command on every built-in system in other units: a minute for each set of units.
UNITS ?= 1 2 3 4
units: all $(BUILD)/tests/change_units
	@UNITS="$(UNITS)" sh tests/cli/run.sh $(PROGRAM) units

# How often trends are right, for each kind of series, length and noise: some minutes.
SERIES ?= 200
trends: $(BUILD)/tests/suite
	@$< --trends $(SERIES)

# For the memory alone, and what crashes: tests/valgrind.sh.  As it takes a second to begin, it has
# VALGRIND_SUITES suites at a time; those that take longest come first, each by itself, so that no processor
# waits for one of them at the end.
VALGRIND_SUITES  ?= 8
VALGRIND_LONGEST = integrators error_budget rank_check phase_volume trend batch conformance model_errors event_branches \
                   adaptive generate_native example_systems phase_composition functions formula chains coefficients parameters
check-valgrind: CHOSEN = $(or $(filter-out --%,$(SUITE)),$(SUITES))
check-valgrind: $(BUILD)/tests/suite
	@BUILD="$(BUILD)" RUN_SUITE="sh tests/valgrind.sh" SUITE_OPTIONS=--quick sh tests/run.sh "$(MAKE)" \
	    $(patsubst %,suite-%,$(filter $(CHOSEN),$(VALGRIND_LONGEST))) \
	    $$(echo $(filter-out $(VALGRIND_LONGEST),$(CHOSEN)) | xargs -r -n $(VALGRIND_SUITES) | sed 's/ /+/g; s/^/suite-/')

# No fuzzer takes a step: the library needs one integrator, and no variant with lanes.
fuzz:
	$(MAKE) BUILD=$(BUILD)/fuzz CC=$(FUZZ_CC) VARIANTS="x1 x1_QUAD" INTEGRATORS=rk4 \
	    CFLAGS="$(CHECKED) -fsanitize=fuzzer-no-link,address,undefined" run-fuzzers

run-fuzzers: $(FUZZERS:%=run-%)
$(FUZZERS:%=run-%): run-%: $(BUILD)/tests/%
	@mkdir -p $<.corpus
	@$< -verbosity=0 -max_total_time=$(FUZZ_SECONDS) -artifact_prefix=$<. $<.corpus systems
	@echo "fuzz: $*: ok"
$(FUZZERS:%=$(BUILD)/tests/%): %: %.o $(STATIC)
	$(call SAY,ld)$(CC) $(CFLAGS) -fsanitize=fuzzer $^ $(LIBS) -o $@

lint: all $(BUILD)/generated/functions.h
	@CC="$(CC)" BUILD=$(BUILD) sh tools/lint/lint.sh

# Faults planted one by one: make mutants MODULE=lib/dynamics/section.c, MODULE=cli OPERATORS=new, or
# MODULE=lib OPERATORS=bounds SANITIZE=1;
# see tools/mutants/mutants.sh.
SEED  ?= 1
COUNT ?= 20
mutants:
	@CC="$(CC)" BUILD="$(BUILD)" OPERATORS="$(OPERATORS)" SANITIZE="$(SANITIZE)" sh tools/mutants/mutants.sh "$(MODULE)" $(SEED) $(COUNT)

# The documents, and the reference of the public headers.
docs:
	@sh tools/site/site.sh $(BUILD)

# The pictures of the README and of docs/
gallery: all
	@sh tools/gallery.sh $(PROGRAM) docs/gallery

# The parts of docs/ that are made; lint and the tests of documents compare them.
references: all
	@sh tools/references.sh $(PROGRAM) $(CHOOSING)

# ---- installation ----------------------------------------------------------------------------

# The directories of the GNU coding standards; DESTDIR comes before each, for packages.
BINDIR     ?= $(PREFIX)/bin
LIBDIR     ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
DATADIR    ?= $(PREFIX)/share
MANDIR     ?= $(DATADIR)/man
DOCDIR     ?= $(DATADIR)/doc/dalembert
PLACES      = $(foreach name,DESTDIR PREFIX BINDIR LIBDIR INCLUDEDIR DATADIR MANDIR DOCDIR,$(name)="$($(name))") \
              BUILD="$(BUILD)" VERSION=$(VERSION) SONAME=$(SONAME)

install: all
	@$(PLACES) sh tools/install.sh install

uninstall:
	@$(PLACES) sh tools/install.sh uninstall

# The tarball of the last commit: the same bytes wherever and whenever it is made.
TARBALL = $(BUILD)/dalembert-$(VERSION).tar
dist:
	@mkdir -p $(BUILD)
	@test -z "$$(git diff-index HEAD)" || echo "dist: changes without a commit are left out" >&2
	git -c tar.umask=022 archive --prefix=dalembert-$(VERSION)/ -o $(TARBALL) HEAD
	gzip -9nf $(TARBALL)

clean:
	rm -rf $(BUILD)

include bench/bench.mk

FORCE:
.PHONY: all help check check-bits check-browser check-cross check-dist check-packages check-python check-sanitize check-valgrind dist docs fuzz run-fuzzers $(FUZZERS:%=run-%) gallery references lint mutants trends units install uninstall clean FORCE mpi
.SECONDARY:

-include $(LIB_OBJ:.o=.d) $(CLI_OBJ:.o=.d) $(MPI_OBJ:.o=.d) $(TEST_OBJ:.o=.d) $(FUZZERS:%=$(BUILD)/tests/%.d)
