/* test_cache.c - compiled objects in a cache: which are loaded, which are compiled again, and what
 * compilers leave that were killed. */
#include "allocation.h"
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "folder.h"
#include <CUnit/CUnit.h>
#include <dirent.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Tests run in a directory of their own. */
static char place[] = "/tmp/dal-cache-XXXXXX";
static int before; /* the directory that was */

static int set_up(void)
{
    before = open(".", O_RDONLY | O_DIRECTORY);
    return before < 0 || !mkdtemp(place) || chdir(place) != 0;
}

static int tear_down(void)
{
    const int back = fchdir(before);
    folder_remove(place);
    return close(before) || back;
}

static const char falling[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2/2\n"
                              "start: {x: 1, y: 1}\n";

static const char cached_model[] = "coordinates: [x, z]\nlagrangian: (x'^2 + z'^2)/2 - 3*z^2/2\n"
                                   "start: {x: 1, z: 1}\n";
static const char cached_rival[] = "coordinates: [x, z]\nlagrangian: (x'^2 + z'^2)/2 - 5*z^2/2\n"
                                   "start: {x: 1, z: 1}\n";

static dal_run *new_run(const char *model)
{
    const dal_run_spec spec = fixture_spec(fixture_system(model), "rk4", DAL_PHYSICAL, 0.01);
    return fixture_run(&spec);
}

/* ---- an object is taken from the cache while it is as it was written ---- */

static const char kept[] = "kept"; /* a cache with one object, the only file in it */

static char *only_object(char *path, size_t size)
{
    DIR *folder = opendir(kept);
    CU_ASSERT_PTR_NOT_NULL_FATAL(folder);
    path[0] = '\0';
    for (const struct dirent *entry; (entry = readdir(folder));)
        if (entry->d_name[0] != '.') snprintf(path, size, "%s/%s", kept, entry->d_name);
    closedir(folder);
    return path;
}

/* The folders in a cache: compilations that are under way, or were killed. */
static int folders_in(const char *path)
{
    struct stat s;
    char name[512];
    int count = 0;
    DIR *folder = opendir(path);
    CU_ASSERT_PTR_NOT_NULL_FATAL(folder);
    for (const struct dirent *entry; (entry = readdir(folder));) {
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        count += entry->d_name[0] != '.' && lstat(name, &s) == 0 && S_ISDIR(s.st_mode);
    }
    closedir(folder);
    return count;
}

static char *content(const char *path, long *length)
{
    FILE *file = fopen(path, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fseek(file, 0, SEEK_END);
    *length = ftell(file);
    rewind(file);
    char *bytes = malloc((size_t)*length);
    CU_ASSERT_EQUAL(fread(bytes, 1, (size_t)*length, file), (size_t)*length);
    fclose(file);
    return bytes;
}

static void put_content(const char *path, const char *bytes, long length)
{
    FILE *file = fopen(path, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_EQUAL(fwrite(bytes, 1, (size_t)length, file), (size_t)length);
    fclose(file);
}

/* How often the compiler has been called, which leaves a letter each time. */
static long compilations(void)
{
    struct stat s;
    return stat("called", &s) == 0 ? (long)s.st_size : 0;
}

static void use_cache(const char *model)
{
    dal_run *run = new_run(model);
    const dal_native_options counted = {.cache = kept, .compiler = "./fake", .patience = 3600};
    CU_ASSERT_EQUAL(dal_run_native(run, &counted, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    dal_run_free(run);
    CU_ASSERT_EQUAL(folder_files(kept), 1);
}

/* Starts no compiler, and takes what others have compiled, of other parameters too. */
static void test_only_cached(void)
{
    const dal_native_options only = {.cache = kept, .compiler = "./fake", .only_cached = true};
    compiler_fake("printf x >>called; exec cc \"$@\"");
    char path[512];
    dal_run *run = new_run(cached_model);
    dal_error error;
    dal_native *native;
    CU_ASSERT_EQUAL(dal_native_begin(&native, run, &only, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_STRING_EQUAL(error.message, "the cache has no such code");
    CU_ASSERT_PTR_NULL(native);
    CU_ASSERT_EQUAL(compilations(), 0);
    use_cache(cached_model);
    CU_ASSERT_EQUAL(compilations(), 1);
    CU_ASSERT_EQUAL(dal_run_native(run, &only, NULL), DAL_STATUS_OK);
    CU_ASSERT(dal_run_is_native(run));
    CU_ASSERT_EQUAL(compilations(), 1);
    dal_run_free(run);
    /* Of the same names and sizes, but another text. */
    run = new_run(cached_rival);
    CU_ASSERT_EQUAL(dal_native_begin(&native, run, &only, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(compilations(), 1);
    dal_run_free(run);
    unlink(only_object(path, sizeof path));
    unlink("called");
    unlink("fake");
}

/* Where no object has the key, which depends on the names of coordinates and methods, no text is
 * made, which takes memory. */
static void test_key(void)
{
    static const char renamed[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 3*y^2/2\n"
                                  "start: {x: 1, y: 1}\n";
    static const struct {
        const char *model, *method;
        bool has_key;
    } cases[] = {{cached_model, "rk4", true},
                 {cached_rival, "rk4", true}, /* other numbers alone */
                 {renamed, "rk4", false},
                 {cached_model, "stormer-verlet", false}};
    const dal_native_options only = {.cache = kept, .only_cached = true};
    compiler_fake("exec cc \"$@\"");
    use_cache(cached_model);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(cases[i].model), cases[i].method, DAL_PHYSICAL, 0.01);
        dal_run *run = fixture_run(&spec);
        dal_native *native;
        allocation_fail_after(1); /* the native itself */
        const dal_status status = dal_native_begin(&native, run, &only, NULL);
        allocation_fail_after(-1);
        CU_ASSERT_EQUAL(status, cases[i].has_key ? DAL_STATUS_MEMORY : DAL_STATUS_UNSUPPORTED);
        dal_run_free(run);
    }
    unlink("fake");
    folder_remove(kept);
}

/* Any byte of it, of what the loader never reads too; cut short, or longer, or empty. */
static void test_changed_object(void)
{
    const char *const model = falling;
    char path[512];
    long length, again;
    compiler_fake("printf x >>called; exec cc \"$@\"");
    use_cache(model);
    use_cache(model);
    CU_ASSERT_EQUAL(compilations(), 1);
    char *bytes = content(only_object(path, sizeof path), &length);
    for (int damage = 0; damage < 6; damage++) {
        const long at[] = {length - 1, length - 8, length - 9, 4};
        char *other = malloc((size_t)length + 1);
        memcpy(other, bytes, (size_t)length);
        other[length] = 'x';
        if (damage < 4) other[at[damage]] ^= 1;
        put_content(path, other, damage < 4 ? length : damage == 4 ? length + 1 : length - 1);
        free(other);
        use_cache(model);
        CU_ASSERT_EQUAL(compilations(), damage + 2);
        other = content(path, &again);
        CU_ASSERT(again == length && memcmp(other, bytes, (size_t)length) == 0);
        free(other);
    }
    put_content(path, "", 0);
    use_cache(model);
    CU_ASSERT_EQUAL(compilations(), 8);
    free(bytes);
    unlink("called");
    unlink("fake");
    folder_remove(kept);
}

/* An object that others may write, or that is another user's, or no file, is made again. */
static void test_object_of_others(void)
{
    static const mode_t modes[] = {0720, 0702, 0777};
    char path[512];
    struct stat s;
    compiler_fake("printf x >>called; umask 0; exec cc \"$@\"");
    use_cache(falling);
    only_object(path, sizeof path);
    for (int i = 0; i < 5; i++) {
        bool is_bad = true;
        if (i < 3) CU_ASSERT_EQUAL(chmod(path, modes[i]), 0);
        if (i == 3) is_bad = chown(path, 12345, (gid_t)-1) == 0; /* only root may give it away */
        if (i == 4) {
            CU_ASSERT_EQUAL(rename(path, "moved"), 0);
            CU_ASSERT_EQUAL(symlink("../moved", path), 0);
        }
        const long made = compilations();
        use_cache(falling);
        CU_ASSERT_EQUAL(compilations(), made + is_bad);
        CU_ASSERT_EQUAL_FATAL(lstat(path, &s), 0);
        CU_ASSERT(S_ISREG(s.st_mode) && s.st_uid == geteuid() && (s.st_mode & 077) == 0);
    }
    unlink("moved");
    unlink("called");
    unlink("fake");
    folder_remove(kept);
}

/* The next compilation removes the folders of those that were killed, not of one that lives:
 * a compiler that waits for a pipe, as a run does that was killed while it runs. */
static void test_abandoned(void)
{
    enum { HASH = 48 };
    const dal_native_options waiting = {.cache = kept, .compiler = "./fake", .patience = 600};
    char folder[64], file[80];
    dal_native *native = NULL;
    int status = 0;
    dal_run *run = new_run(falling);
    CU_ASSERT_EQUAL_FATAL(mkfifo("held", 0600), 0);
    const int pipe = open("held", O_RDWR);
    compiler_fake("read line <held; exec cc \"$@\"");
    const pid_t killed = fork();
    if (killed == 0) {
        dal_native_begin(&native, run, &waiting, NULL);
        _exit(0); /* and leaves its folder to the compiler, which lives */
    }
    CU_ASSERT_EQUAL(waitpid(killed, &status, 0), killed);
    snprintf(folder, sizeof folder, "%s/%0*d.so.killed", kept, HASH, 0);
    CU_ASSERT_EQUAL(mkdir(folder, 0700), 0);
    for (int i = 0; i < 3; i++) {
        snprintf(file, sizeof file, "%s/%s", folder, i == 0 ? "code.c" : i == 1 ? "code.so" : "x");
        put_content(file, "int x;", 6);
    }
    CU_ASSERT_EQUAL(folders_in(kept), 2);
    dal_run *other = new_run("vertical-disk");
    CU_ASSERT_EQUAL(
        dal_run_native(other, &(dal_native_options){.cache = kept, .patience = 3600}, NULL),
        DAL_STATUS_OK);
    CU_ASSERT_NOT_EQUAL(access(folder, F_OK), 0);
    CU_ASSERT_EQUAL(folders_in(kept), 1);
    CU_ASSERT_EQUAL(write(pipe, "\n", 1), 1); /* the compiler goes on, and ends */
    for (int i = 0; i < 600 && folders_in(kept) > 0; i++) {
        nanosleep(&(struct timespec){0, 100000000}, NULL);
        dal_run *next = new_run("vertical-disk");
        CU_ASSERT_EQUAL(
            dal_run_native(next, &(dal_native_options){.cache = kept, .patience = 3600}, NULL),
            DAL_STATUS_OK);
        dal_run_free(next);
    }
    CU_ASSERT_EQUAL(folders_in(kept), 0);
    dal_run_free(run);
    dal_run_free(other);
    close(pipe);
    unlink("held");
    unlink("fake");
    folder_remove(kept);
}

/* A folder with a link for a source is of no compilation, and is left. */
static void test_linked_source(void)
{
    enum { HASH = 48 };
    char folder[64], link[80];
    struct stat status;
    snprintf(folder, sizeof folder, "%s/%0*d.so.linked", kept, HASH, 0);
    snprintf(link, sizeof link, "%s/code.c", folder);
    CU_ASSERT_EQUAL(mkdir(kept, 0700), 0);
    CU_ASSERT_EQUAL(mkdir(folder, 0700), 0);
    put_content("elsewhere.c", "int x;", 6);
    CU_ASSERT_EQUAL(symlink("../../elsewhere.c", link), 0);
    dal_run *run = new_run(falling);
    CU_ASSERT_EQUAL(
        dal_run_native(run, &(dal_native_options){.cache = kept, .patience = 3600}, NULL),
        DAL_STATUS_OK);
    CU_ASSERT_EQUAL(lstat(link, &status), 0);
    CU_ASSERT_EQUAL(access("elsewhere.c", F_OK), 0);
    dal_run_free(run);
    unlink(link);
    unlink("elsewhere.c");
    folder_remove(kept);
}

/* Another text, and another command, has an object of its own. */
static void test_objects_apart(void)
{
    const char *const compilers[] = {"./fake", "./same"};
    compiler_fake("exec cc \"$@\"");
    CU_ASSERT_EQUAL(symlink("fake", "same"), 0);
    for (int i = 0; i < 4; i++) {
        const dal_native_options with = {
            .cache = kept, .compiler = compilers[i % 2], .patience = 3600};
        const dal_run_spec spec = fixture_spec(fixture_system(falling),
                                               i < 2 ? "rk4" : "stormer-verlet", DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_native(run, &with, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(folder_files(kept), i + 1);
        dal_run_free(run);
    }
    unlink("fake");
    unlink("same");
    folder_remove(kept);
}

void suite_cache(void);
void suite_cache(void)
{
    CU_pSuite suite = CU_add_suite("cache", set_up, tear_down);
    if (!compiler_there()) return;
    CU_add_test(suite, "code of the cache alone", test_only_cached);
    CU_add_test(suite, "no text without a key", test_key);
    CU_add_test(suite, "an object that was changed", test_changed_object);
    CU_add_test(suite, "objects of other texts and commands", test_objects_apart);
    CU_add_test(suite, "objects that others may write", test_object_of_others);
    CU_add_test(suite, "folders of compilers that were killed", test_abandoned);
    CU_add_test(suite, "a folder with a link for a source", test_linked_source);
}
