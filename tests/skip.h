/* skip.h - tests that cannot be made on this machine say so; where CI is true they fail. */
#ifndef SKIP_H
#define SKIP_H

/* Prints that a test, or a part of it, is not made, and why. */
void skip_test(const char *reason);
/* Prints how often that was; how many failures these are. */
unsigned skip_failures(void);

#endif
