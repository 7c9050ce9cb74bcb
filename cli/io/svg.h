/* svg.h - figures of gnuplot for pages. */
#ifndef DAL_CLI_SVG_H
#define DAL_CLI_SVG_H

#include <stdio.h>

/* Rewrites a file of gnuplot's svg terminal: readable on white and on black, and without what has
 * no effect; with a line of numbers that says where the axes are, for who reads values off it.
 * Returns CLI_DONE, or prints and returns an exit status. */
int svg_tidy(const char *path, const char *axes);
/* Writes the text of an SVG file as a URL, data:image/svg+xml,..., for an attribute in '. */
void svg_write_url(FILE *out, const char *svg);

#endif
