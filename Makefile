# dalembert - make, make check, make lint, make install; BUILD=dir puts everything elsewhere.
BUILD   ?= build
CC      ?= cc
CFLAGS  ?= -O2 -g
WARN     = -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla \
           -Wpointer-arith -Wwrite-strings -Wno-psabi
ALL      = -std=c11 $(WARN) -ffp-contract=off -fno-math-errno -fPIC -fvisibility=hidden \
           -Iinclude -Ilib $(CFLAGS)

# Sources over num are compiled once per width: files named *_wide.c, and every integrator.
WIDE_SRC = $(wildcard lib/*/*_wide.c integrators/*.c)
LIB_SRC  = $(filter-out $(WIDE_SRC),$(wildcard lib/*.c lib/*/*.c))
LIB_OBJ  = $(LIB_SRC:%.c=$(BUILD)/%.o) $(foreach w,1 4 8,$(WIDE_SRC:%.c=$(BUILD)/%_x$(w).o))

all: $(BUILD)/libdalembert.a

$(BUILD)/%_x1.o: %.c
	@mkdir -p $(@D)
	$(CC) $(ALL) -DDAL_LANES=1 -MMD -MP -c $< -o $@
$(BUILD)/%_x4.o: %.c
	@mkdir -p $(@D)
	$(CC) $(ALL) -DDAL_LANES=4 -MMD -MP -c $< -o $@
$(BUILD)/%_x8.o: %.c
	@mkdir -p $(@D)
	$(CC) $(ALL) -DDAL_LANES=8 -MMD -MP -c $< -o $@
$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(ALL) -MMD -MP -c $< -o $@
$(BUILD)/libdalembert.a: $(LIB_OBJ)
	rm -f $@; ar rcs $@ $^
.PHONY: all
-include $(LIB_OBJ:.o=.d)
