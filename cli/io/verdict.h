/* verdict.h - size and trend of a quantity in words, for a screen.
 *
 * The first word of a verdict is one that `expect:` of a study understands; the text says what it
 * means, with numbers of two digits. */
#ifndef DAL_CLI_VERDICT_H
#define DAL_CLI_VERDICT_H

#include "dalembert_statistics.h"
#include "ui/screen.h"

enum { VERDICT_TEXT = 160 };

typedef struct verdict {
    const char *word;
    char text[VERDICT_TEXT];
    screen_colour colour;
} verdict;

verdict verdict_of(const dal_trend *trend);

#endif
