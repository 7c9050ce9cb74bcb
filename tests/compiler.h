/* compiler.h - compilers of native mode, for the suites that compile. */
#ifndef COMPILER_H
#define COMPILER_H

#include <stdbool.h>

/* Whether there is a cc; says where there is none. */
bool compiler_there(void);
/* Makes a script of sh the compiler ./fake of the current directory. */
void compiler_fake(const char *script);

#endif
