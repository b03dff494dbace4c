/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Files are those of proc(5) and of Linux's cgroups(7); on other systems there are none, and what the machine has in
 * all counts. Pages of files that nobody has changed are given up when memory is short, so they count as left.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "base/room.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#define GROUPS_MAX 32 /* levels of control groups */

static void take_less(struct room *r, uint64_t bytes, const char *what)
{
	if (bytes >= r->bytes)
		return;
	r->bytes = bytes;
	snprintf(r->what, sizeof(r->what), "%s", what);
}

static FILE *open_below(const char *root, const char *folder, const char *name)
{
	char path[PATH_MAX];

	if (snprintf(path, sizeof(path), "%s%s/%s", root, folder, name) >= (int)sizeof(path))
		return NULL;
	return fopen(path, "re");
}

/* The number behind key, at the beginning of a line, or with no key the first one of the file. "max" is none. */
static bool number_in(const char *root, const char *folder, const char *name, const char *key, uint64_t *out)
{
	FILE *f = open_below(root, folder, name);
	char line[256], *end;
	bool found = false;
	size_t n = key ? strlen(key) : 0;

	while (f && !found && fgets(line, sizeof(line), f)) {
		if (key && (strncmp(line, key, n) || !strchr(" :\t", line[n])))
			continue;
		*out = strtoull(line + n + (key && line[n] == ':'), &end, 10);
		found = end > line + n + (key && line[n] == ':');
	}
	if (f)
		fclose(f);
	return found;
}

struct group_files {
	const char *mount, *limit, *used, *stat_key;
};

static const struct group_files group_v2 = { "/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file" };
static const struct group_files group_v1 = { "/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
					     "total_inactive_file" };

static void look_at_group(struct room *r, const char *root, const struct group_files *g, const char *path)
{
	char folder[PATH_MAX];
	uint64_t limit, used, cached = 0;

	if (snprintf(folder, sizeof(folder), "%s%s", g->mount, path) >= (int)sizeof(folder) ||
	    !number_in(root, folder, g->limit, NULL, &limit) || !number_in(root, folder, g->used, NULL, &used))
		return;
	number_in(root, folder, "memory.stat", g->stat_key, &cached);
	used -= cached < used ? cached : used;
	take_less(r, limit > used ? limit - used : 0, "of what its control group allows");
}

/* The group and all above it. In a container the path may be that of the world outside, which isn't there; its own
 * group is the mount's root. */
static void look_at_groups(struct room *r, const char *root, const struct group_files *g, char *path)
{
	for (int i = 0; i < GROUPS_MAX; i++) {
		char *slash = strrchr(path, '/');

		look_at_group(r, root, g, strcmp(path, "/") ? path : "");
		if (!slash || !*path || !strcmp(path, "/"))
			break;
		*slash = 0;
	}
}

/* Is the word in a list like "cpu,memory"? */
static bool names(const char *list, const char *word)
{
	size_t n = strlen(word);

	for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
		if (!strncmp(at, word, n) && (!at[n] || at[n] == ','))
			return true;
	}
	return false;
}

static void find_groups(struct room *r, const char *root)
{
	FILE *f = open_below(root, "/proc/self", "cgroup");
	char line[PATH_MAX];

	while (f && fgets(line, sizeof(line), f)) {
		char *list = strchr(line, ':'), *path = list ? strchr(list + 1, ':') : NULL;

		if (!path)
			continue;
		*path++ = 0;
		path[strcspn(path, "\n")] = 0;
		if (!list[1])
			look_at_groups(r, root, &group_v2, path);
		else if (names(list + 1, "memory"))
			look_at_groups(r, root, &group_v1, path);
	}
	if (f)
		fclose(f);
}

static void look_at_limit(struct room *r, const char *root, const struct rlimit *l, const char *key, const char *what)
{
	uint64_t used = 0;

	if (l->rlim_cur == RLIM_INFINITY)
		return;
	if (number_in(root, "/proc/self", "status", key, &used))
		used *= 1024;
	take_less(r, l->rlim_cur > used ? l->rlim_cur - used : 0, what);
}

static void find_limits(struct room *r, const char *root)
{
	struct rlimit l;

	if (!getrlimit(RLIMIT_AS, &l))
		look_at_limit(r, root, &l, "VmSize", "of what ulimit -v allows");
	if (!getrlimit(RLIMIT_DATA, &l))
		look_at_limit(r, root, &l, "VmData", "of what ulimit -d allows");
}

void room_find(struct room *r, const char *root)
{
	uint64_t bytes;

	*r = (struct room){ .bytes = UINT64_MAX };
	if (number_in(root, "/proc", "meminfo", "MemAvailable", &bytes))
		take_less(r, bytes * 1024, "on this machine");
#ifdef _SC_PHYS_PAGES
	else if (sysconf(_SC_PHYS_PAGES) > 0)
		take_less(r, (uint64_t)sysconf(_SC_PHYS_PAGES) * (uint64_t)sysconf(_SC_PAGESIZE), "on this machine");
#endif
	find_groups(r, root);
	find_limits(r, root);
}

uint64_t room_process_most(void)
{
	struct rusage u;

	return getrusage(RUSAGE_SELF, &u) ? 0 : 1024 * (uint64_t)u.ru_maxrss;
}
