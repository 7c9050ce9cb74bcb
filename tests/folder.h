/* folder.h - folders of plain files that a test makes and takes away. */
#ifndef FOLDER_H
#define FOLDER_H

/* Plain files in a folder; -1: there is none. */
int folder_files(const char *path);
/* Removes it with its plain files. */
void folder_remove(const char *path);

#endif
