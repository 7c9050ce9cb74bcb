/* compiler.h - compilers of native mode, for the suites that compile. */
#ifndef COMPILER_H
#define COMPILER_H

#include <dalembert_codegen.h>
#include <stdbool.h>

/* Whether there is a cc; says where there is none. */
bool compiler_there(void);
/* Options for the instruction set of this machine; -march=native may give more than valgrind
 * has. */
const char *compiler_machine(void);
/* Set-up and tear-down of a suite that compiles into a folder of its own: whether it can, the
 * folder, and options with it as their cache. */
extern bool compiler_works;
extern char compiler_folder[];
extern const dal_native_options compiler_options;
int compiler_set_up(void);
int compiler_tear_down(void);
/* Makes a script of sh the compiler ./fake of the current directory. */
void compiler_fake(const char *script);

#endif
