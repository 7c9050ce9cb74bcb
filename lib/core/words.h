/* words.h - the words of an X-list.
 *
 *     const char *dal_status_text(dal_status status)
 *     {
 *         DAL__RETURN_WORD(DAL_STATUS_LIST, DAL__SECOND, status, "unknown status");
 *     } */
#ifndef DAL_WORDS_H
#define DAL_WORDS_H

#define DAL__FIRST_OF(first, ...) first
/* The second column of a list of rows (code, word) or (code, word, ...), with a comma after it. */
#define DAL__SECOND(code, ...) DAL__FIRST_OF(__VA_ARGS__, 0),
/* The third column of a list of rows (code, word, text). */
#define DAL__THIRD(code, word, text) text,

/* Returns from a function with the word of a value, or another where the list has none. */
#define DAL__RETURN_WORD(LIST, COLUMN, value, other)                                               \
    static const char *const dal__words[] = {LIST(COLUMN)};                                        \
    return (unsigned)(value) < sizeof dal__words / sizeof *dal__words ? dal__words[value] : (other)

#endif
