/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The rules of alidade-accel(3), "Where plugins are found": a name is looked up in trusted folders only,
 * never in the working directory or on the linker's path; all that can be checked without running the
 * plugin's code is checked before dlopen(), the rest before the first call.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "accel/load.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "accel/elf.h"
#include "accel/param.h"
#include "accel/text.h"
#include "base/process.h"

#define ENTRY "ald_accel_entry"
#define NAME_MAX_BYTES 64
#define FOLDERS_MAX 64
/* What the first version of the contract has; everything after it is optional. */
#define SIZE_MIN offsetof(ald_accel_plugin, scratch_size)
#define SIZE_LARGEST 65536

struct folders {
	char *text; /* owns what at[] points into */
	const char *at[FOLDERS_MAX];
	uint32_t count;
};

static const char *path_variable(void)
{
#ifdef HAVE_SECURE_GETENV
	return secure_getenv("ALIDADE_ACCEL_PATH");
#else
	return getuid() == geteuid() && getgid() == getegid() ? getenv("ALIDADE_ACCEL_PATH") : NULL;
#endif
}

/* $ALIDADE_ACCEL_PATH's folders, then the installed one. Relative ones would make the working directory
 * decide what code runs. */
static enum status folders_init(struct folders *f, struct diag *d)
{
	const char *variable = path_variable();
	char *next;

	*f = (struct folders){ .text = strdup(variable ? variable : "") };
	if (!f->text)
		return diag_no_memory(d, "the search path for accelerators", 0);
	for (char *at = f->text; at && f->count < FOLDERS_MAX - 1; at = next) {
		next = strchr(at, ':');
		if (next)
			*next++ = 0;
		if (*at == '/')
			f->at[f->count++] = at;
		else if (*at)
			diag_report(d, DIAG_WARNING, NULL,
				    "ALIDADE_ACCEL_PATH: '%s' is left out: only absolute folders are "
				    "searched",
				    at);
	}
	f->at[f->count++] = ALIDADE_PLUGIN_DIR;
	return STATUS_OK;
}

static void folders_release(struct folders *f)
{
	free(f->text);
}

static int compare_names(const void *a, const void *b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

static void free_names(char **name, size_t n)
{
	for (size_t i = 0; i < n; i++)
		free(name[i]);
	free(name);
}

/* The names NAME of the files NAME.so in a folder, sorted. An unreadable folder has none. */
static size_t plugin_names(const char *folder, char ***out)
{
	DIR *dir = opendir(folder);
	struct dirent *e;
	char **name = NULL, **more;
	size_t n = 0;

	*out = NULL;
	if (!dir)
		return 0;
	while ((e = readdir(dir)) && n < 4096) {
		size_t length = strlen(e->d_name);

		if (length < 4 || strcmp(e->d_name + length - 3, ".so") ||
		    !param_name_ok(e->d_name, length - 3))
			continue;
		more = realloc(name, (n + 1) * sizeof(*name));
		if (!more)
			break;
		name = more;
		name[n] = strndup(e->d_name, length - 3);
		if (!name[n])
			break;
		n++;
	}
	closedir(dir);
	if (n)
		qsort(name, n, sizeof(*name), compare_names);
	*out = name;
	return n;
}

static enum status not_found(const struct folders *f, const char *asked, struct diag *d)
{
	struct text where = { 0 }, hint = { 0 };
	char **name;
	size_t n;

	for (uint32_t i = 0; i < f->count; i++) {
		n = plugin_names(f->at[i], &name);
		text_add(&where, "%s%s (", i ? "; " : "", f->at[i]);
		for (size_t j = 0; j < n; j++) {
			text_add(&where, "%s%s", j ? ", " : "", name[j]);
			if (!hint.used && text_alike(asked, name[j]))
				text_add(&hint, " Did you mean '%s'?", name[j]);
		}
		text_add(&where, "%s)", n ? "" : access(f->at[i], R_OK | X_OK) ? strerror(errno) : "none");
		free_names(name, n);
	}
	return diag_fail(d, STATUS_ACCEL, NULL,
			 "no accelerator '%s'.%s Searched: %s. A folder is added with "
			 "ALIDADE_ACCEL_PATH, a file is named by a path with a slash.",
			 asked, hint.s, where.s);
}

static enum status refuse(struct diag *d, const char *path, const char *why, const char *remedy)
{
	return diag_fail(d, STATUS_ACCEL, NULL, "accelerator %s: %s%s%s", path, why, remedy ? "; " : "",
			 remedy ? remedy : "");
}

/* Whoever may write the file decides what this process does. In a folder such as /tmp (sticky) others
 * can't replace a file, so there it has to be the user's own, or the system's. */
static enum status check_trust(const char *path, const char *real, struct diag *d)
{
	char folder[PATH_MAX];
	struct stat st, up;

	snprintf(folder, sizeof(folder), "%s", real);
	*strrchr(folder, '/') = 0;
	if (!folder[0])
		strcpy(folder, "/");
	if (stat(real, &st) || stat(folder, &up))
		return refuse(d, path, strerror(errno), NULL);
	if (S_ISDIR(st.st_mode))
		return refuse(d, path, "this is a folder", "give the .so file in it");
	if (!S_ISREG(st.st_mode))
		return refuse(d, path, "this is not an ordinary file", NULL);
	if (st.st_mode & S_IWOTH)
		return refuse(d, path, "anyone may write to this file, so it is not run",
			      "say chmod o-w on it if you trust it");
	if (!(up.st_mode & S_IWOTH))
		return STATUS_OK;
	if (!(up.st_mode & S_ISVTX))
		return refuse(d, path, "anyone may write to its folder, so it is not run",
			      "say chmod o-w on the folder if you trust it, or move the file");
	if (st.st_uid != geteuid() && st.st_uid != 0)
		return refuse(d, path, "another user put it into a folder open to all, so it is not run",
			      "copy it to a folder of your own if you trust it");
	return STATUS_OK;
}

static enum status check_versions(const char *path, uint32_t abi, uint32_t size, struct diag *d)
{
	if (abi != ALD_ACCEL_ABI)
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator %s: it speaks ABI %u, this program ABI %u; build it again "
				 "with this version's <alidade/accel.h>",
				 path, abi, ALD_ACCEL_ABI);
	if (size < SIZE_MIN || size > SIZE_LARGEST)
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator %s: its entry states a size of %u bytes, which is not "
				 "between %zu and %d; size must be sizeof(ald_accel_plugin)",
				 path, size, SIZE_MIN, SIZE_LARGEST);
	return STATUS_OK;
}

/* name is what the file's name promises. */
static enum status check_entry(const ald_accel_plugin *p, const char *path, const char *name,
			       struct diag *d)
{
	const uint32_t known = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST;
	const char *fault, *which;
	uint32_t params = 0; /* 32 at most */

	if (!p->name || strcmp(p->name, name))
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator %s: it calls itself '%s'; the file has to be named %s.so",
				 path, p->name ? p->name : "(nothing)", p->name ? p->name : "NAME");
	if (!p->version || !p->license || !p->summary)
		return refuse(d, path, "its version, license or summary is missing", NULL);
	fault = param_table_fault(p->params, &which);
	if (fault)
		return diag_fail(d, STATUS_ACCEL, NULL, "accelerator %s: its parameter '%s' is wrong: %s",
				 path, which, fault);
	if (!(p->precisions & known))
		return refuse(d, path, "it states no precision that it can serve",
			      "set precisions to ALD_PRECISION_DEFAULT");
	while (p->params && p->params[params].name)
		params++;
	if ((uint64_t)p->inexact >> params)
		return refuse(d, path, "its inexact has a bit for a parameter that it has not", NULL);
	if (!p->build || !p->intersect || !p->destroy)
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator %s: its function %s is missing; build, intersect and "
				 "destroy are required",
				 path,
				 !p->build     ? "build" :
				 !p->intersect ? "intersect" :
						 "destroy");
	return STATUS_OK;
}

/* An older plugin's entry ends earlier, and a newer one's later: work on a copy of our own length. */
static enum status take_entry(struct accel_choice *c, const char *name, struct diag *d)
{
	const ald_accel_plugin *theirs = dlsym(c->handle, ENTRY);
	ald_accel_plugin *copy;
	enum status st;

	if (!theirs)
		return refuse(d, c->path, "it does not export the symbol " ENTRY ": it is no accelerator",
			      NULL);
	st = check_versions(c->path, theirs->abi, theirs->size, d);
	if (st)
		return st;
	copy = calloc(1, sizeof(*copy));
	if (!copy)
		return diag_no_memory(d, "an accelerator's entry", sizeof(*copy));
	c->plugin = copy;
	memcpy(copy, theirs, theirs->size < sizeof(*copy) ? theirs->size : sizeof(*copy));
	return check_entry(copy, c->path, name, d);
}

static enum status open_plugin(struct accel_choice *c, const char *name, struct diag *d)
{
	char real[PATH_MAX];
	struct elf_peek peek;
	const char *fault;
	enum status st;

	if (!realpath(c->path, real))
		return refuse(d, c->path, strerror(errno), NULL);
	st = check_trust(c->path, real, d);
	if (st)
		return st;
	fault = elf_peek_file(real, ENTRY, &peek);
	if (fault)
		return refuse(d, c->path, fault, NULL);
	if (peek.found) {
		st = check_versions(c->path, peek.abi, peek.size, d);
		if (st)
			return st;
	}
	c->handle = process_load(real, RTLD_NOW | RTLD_LOCAL);
	if (!c->handle)
		return refuse(d, c->path, "it can't be loaded", dlerror());
	return take_entry(c, name, d);
}

static enum status find_by_name(struct accel_choice *c, const char *name, struct diag *d)
{
	struct folders f;
	enum status st;
	bool found = false;

	if (!param_name_ok(name, strlen(name)))
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "'%s' can't be an accelerator's name, which is of the form "
				 "[a-z][a-z0-9-]*; a file is named by a path with a slash: ./%s",
				 name, name);
	st = folders_init(&f, d);
	if (st)
		return st;
	for (uint32_t i = 0; i < f.count && !found; i++) {
		int n = snprintf(c->path, sizeof(c->path), "%s/%s.so", f.at[i], name);

		found = n > 0 && (size_t)n < sizeof(c->path) && !access(c->path, F_OK);
	}
	if (!found)
		st = not_found(&f, name, d);
	folders_release(&f);
	return st ? st : open_plugin(c, name, d);
}

static enum status find_by_path(struct accel_choice *c, const char *path, struct diag *d)
{
	const char *base = strrchr(path, '/') + 1;
	size_t length = strlen(base);
	char name[NAME_MAX_BYTES + 1];

	snprintf(c->path, sizeof(c->path), "%s", path);
	if (access(path, F_OK))
		return refuse(d, path, strerror(errno), NULL);
	if (length < 4 || strcmp(base + length - 3, ".so") || !param_name_ok(base, length - 3))
		return refuse(d, path, "a plugin's file is named NAME.so with NAME of [a-z][a-z0-9-]*",
			      NULL);
	snprintf(name, sizeof(name), "%.*s", (int)(length - 3), base);
	return open_plugin(c, name, d);
}

enum status accel_load(struct accel_choice *c, const char *spec, struct diag *d)
{
	const char *slash = strrchr(spec, '/');
	const char *colon = strchr(slash ? slash : spec, ':');
	size_t length = colon ? (size_t)(colon - spec) : strlen(spec);
	char what[sizeof(c->path)];
	enum status st;

	*c = (struct accel_choice){ .plugin = NULL };
	if (!length || length >= sizeof(what))
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "an accelerator is given as NAME, NAME:KEY=VALUE,... or a path with a "
				 "slash");
	memcpy(what, spec, length);
	what[length] = 0;
	st = slash ? find_by_path(c, what, d) : find_by_name(c, what, d);
	if (!st)
		st = param_parse(c->plugin->params, colon ? colon + 1 : NULL, c->value, c->plugin->name,
				 d);
	if (st)
		accel_unload(c);
	return st;
}

void accel_unload(struct accel_choice *c)
{
	if (c->handle) {
		free((void *)c->plugin);
		dlclose(c->handle);
	}
	c->plugin = NULL;
	c->handle = NULL;
}

/* In a list a broken plugin is worth a warning, and no more. */
static void as_warning(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	diag_report(arg, level == DIAG_ERROR ? DIAG_WARNING : level, pos, "%s", text);
}

static bool shadowed(const struct folders *f, uint32_t folder, const char *name)
{
	char path[PATH_MAX];

	for (uint32_t i = 0; i < folder; i++) {
		snprintf(path, sizeof(path), "%s/%s.so", f->at[i], name);
		if (!access(path, F_OK))
			return true;
	}
	return false;
}

static void list_one(const char *folder, const char *name,
		     void (*visit)(void *arg, const struct accel_choice *), void *arg, struct diag *d)
{
	struct diag inner = { .sink = as_warning, .arg = d };
	struct accel_choice c = { .plugin = NULL };

	snprintf(c.path, sizeof(c.path), "%s/%s.so", folder, name);
	if (!open_plugin(&c, name, &inner) &&
	    !param_parse(c.plugin->params, NULL, c.value, name, &inner))
		visit(arg, &c);
	accel_unload(&c);
}

enum status accel_list(void (*visit)(void *arg, const struct accel_choice *), void *arg, struct diag *d)
{
	struct folders f;
	enum status st = folders_init(&f, d);
	char **name;
	size_t n;

	for (uint32_t i = 0; !st && i < f.count; i++) {
		n = plugin_names(f.at[i], &name);
		for (size_t j = 0; j < n; j++) {
			if (!shadowed(&f, i, name[j]))
				list_one(f.at[i], name[j], visit, arg, d);
		}
		free_names(name, n);
	}
	if (!st)
		folders_release(&f);
	return st;
}

const char *accel_precision_name(uint32_t precision)
{
	return precision == ALD_PRECISION_EXACT ? "exact" : precision == ALD_PRECISION_FAST ? "fast" : "default";
}

struct serving { /* a list of those that serve a precision */
	uint32_t precision;
	struct text names;
};

static void add_serving(void *arg, const struct accel_choice *c)
{
	struct serving *s = arg;

	if (c->plugin->precisions & s->precision)
		text_add(&s->names, "%s%s", s->names.used ? ", " : "", c->plugin->name);
}

const ald_param *accel_inexact(const struct accel_choice *c)
{
	const ald_param *p = c->plugin->params;

	for (uint32_t i = 0; p && p[i].name; i++) {
		if (c->plugin->inexact >> i & 1 && (c->value[i] < p[i].def || c->value[i] > p[i].def))
			return &p[i];
	}
	return NULL;
}

enum status accel_set_precision(struct accel_choice *c, uint32_t precision, struct diag *d)
{
	struct serving s = { .precision = precision };
	const ald_param *inexact = accel_inexact(c);
	enum status st;

	c->precision = precision;
	if (inexact && precision == ALD_PRECISION_EXACT)
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator %s: what %s asks for (%s) is inexact, and --precision=exact is asked "
				 "for too; leave one out", c->plugin->name, inexact->name, inexact->help);
	if (c->plugin->precisions & precision)
		return STATUS_OK;
	st = accel_list(add_serving, &s, d);
	return st ? st :
		    diag_fail(d, STATUS_ACCEL, NULL,
			      "accelerator %s: it does not serve --precision=%s; these do: %s",
			      c->plugin->name, accel_precision_name(precision),
			      s.names.used ? s.names.s : "none of those installed");
}

int accel_describe(const struct accel_choice *c, char *out, size_t size)
{
	const ald_param *p = c->plugin->params;
	struct text t = { 0 };
	char value[256];

	text_add(&t, "%s", c->plugin->name);
	for (uint32_t i = 0; p && p[i].name; i++) {
		param_value_text(&p[i], c->value[i], value, sizeof(value));
		text_add(&t, "%s%s=%s", i ? "," : ":", p[i].name, value);
	}
	return snprintf(out, size, "%s", t.s);
}
