/* tar.c - an archive of files, as tar reads it: for each a block of 512 bytes, then its bytes,
 * filled up to whole blocks; two empty blocks in the end.  IEEE Std 1003.1, pax, "ustar Interchange
 * Format". */
#include "tar.h"
#include "ui/message.h"

#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>

enum { BLOCK = 512, PREFIX = 155 };

/* The block before a file; numbers are octal texts. */
typedef struct header {
    char name[100], mode[8], user[8], group[8], size[12], time[12], checksum[8], type, link[100];
    char magic[6], version[2], user_name[32], group_name[32], device[16], prefix[PREFIX], rest[12];
} header;

/* A name, and what is before one of its slashes where it is too long.  Returns whether both fit. */
static bool put_name(header *h, const char *name)
{
    const char *rest = name;
    while (rest && strlen(rest) > sizeof h->name) {
        rest = strchr(rest, '/');
        rest += rest != NULL;
    }
    const size_t before = rest ? (size_t)(rest - name) : 0;
    if (!rest || before > sizeof h->prefix) return false;
    if (before > 0) memcpy(h->prefix, name, before - 1);
    memcpy(h->name, rest, strlen(rest));
    return true;
}

static int put_header(FILE *out, const char *name, unsigned long long length)
{
    header h = {.mode = "0000644", .user = "0000000", .group = "0000000", .type = '0'};
    unsigned sum = 0;
    char number[32];
    if (!put_name(&h, name)) return cli_fail(CLI_USAGE, "'%s' is too long a name", name);
    snprintf(number, sizeof number, "%011llo", length);
    if (strlen(number) >= sizeof h.size) return cli_fail(CLI_USAGE, "'%s' has 8 GB or more", name);
    memcpy(h.size, number, sizeof h.size);
    memset(h.time, '0', sizeof h.time - 1);
    memcpy(h.magic, "ustar", sizeof h.magic);
    memcpy(h.version, "00", sizeof h.version);
    memset(h.checksum, ' ', sizeof h.checksum);
    for (size_t i = 0; i < sizeof h; i++) sum += ((const unsigned char *)&h)[i];
    snprintf(h.checksum, sizeof h.checksum, "%06o", sum & 0777777u);
    fwrite(&h, 1, sizeof h, out);
    return CLI_DONE;
}

static void fill_block(FILE *out, unsigned long long length)
{
    static const char zeros[BLOCK];
    fwrite(zeros, 1, (size_t)((BLOCK - length % BLOCK) % BLOCK), out);
}

int tar_add(FILE *out, const char *name, const void *bytes, size_t length)
{
    const int status = put_header(out, name, length);
    if (status != CLI_DONE) return status;
    fwrite(bytes, 1, length, out);
    fill_block(out, length);
    return CLI_DONE;
}

/* Copies what the header says, even of a file that another process makes longer. */
static int copy_bytes(FILE *out, FILE *in, const char *path, unsigned long long length)
{
    char bytes[1 << 16];
    for (unsigned long long rest = length; rest > 0;) {
        const size_t count = fread(bytes, 1, rest < sizeof bytes ? (size_t)rest : sizeof bytes, in);
        if (count == 0)
            return ferror(in) ? cli_io("read", path)
                              : cli_fail(CLI_IO, "'%s' became shorter while it was read", path);
        fwrite(bytes, 1, count, out);
        rest -= count;
    }
    fill_block(out, length);
    return CLI_DONE;
}

int tar_add_file(FILE *out, const char *name, const char *path)
{
    struct stat state;
    FILE *in = fopen(path, "rb");
    if (!in || fstat(fileno(in), &state) != 0) {
        const int status = cli_io("read", path);
        if (in) fclose(in);
        return status;
    }
    const unsigned long long length = (unsigned long long)state.st_size;
    int status = put_header(out, name, length);
    if (status == CLI_DONE) status = copy_bytes(out, in, path, length);
    fclose(in);
    return status;
}

void tar_end(FILE *out)
{
    static const char zeros[2 * BLOCK];
    fwrite(zeros, 1, sizeof zeros, out);
}
