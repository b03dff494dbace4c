/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Where characters come from: files, kept mapped until reading ends because macros point into them, and
 * where #include looks for them (manual 3.2.5.4, 3.3.2.1).
 */
#include <config.h>

#include "read/pov/internal.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#define PURPOSE "reading"

/* Where POV-Ray 3.7's standard include files are installed. */
static const char *const system_folder[] = {
	"/usr/local/share/povray-3.7/include/", "/usr/share/povray-3.7/include/",
	"/usr/local/share/povray/include/", "/usr/share/povray/include/",
	"/opt/homebrew/share/povray-3.7/include/", "/usr/share/povray-3.8/include/",
};

static struct source *source_push(struct pov *p)
{
	struct source *s = p->spare_source;

	if (s)
		p->spare_source = s->below;
	else
		s = pov_alloc(p, sizeof(*s));
	if (!s)
		return NULL;
	*s = (struct source){ .below = p->source, .conds = p->conds.count };
	if (p->source && !scope_open(p))
		return NULL;
	s->depth = scope_depth(p);
	p->source = s;
	return s;
}

bool source_push_text(struct pov *p, const char *file, const char *folder, const char *bytes,
		      size_t size)
{
	struct source *s = source_push(p);

	if (!s)
		return false;
	if (size >= 3 && !memcmp(bytes, "\xef\xbb\xbf", 3)) { /* a byte order mark */
		bytes += 3;
		size -= 3;
	}
	s->p = (struct place){ bytes, bytes, 1 };
	s->end = bytes + size;
	s->file = file;
	s->folder = folder;
	return true;
}

bool source_push_macro(struct pov *p, struct macro *m)
{
	struct source *s;
	const char *folder = p->source->folder;

	if (p->macro_depth >= p->limit.macro_depth) {
		struct diag_pos pos = source_pos(p);

		pov_limit(p, &pos, "macro_depth", p->limit.macro_depth, "macros call each other too deeply");
		return false;
	}
	s = source_push(p);
	if (!s)
		return false;
	p->macro_depth++;
	s->p = m->body;
	s->end = m->end;
	s->file = m->file;
	s->folder = folder;
	s->macro = m;
	return true;
}

void source_pop(struct pov *p)
{
	struct source *s = p->source;

	if (s->macro)
		p->macro_depth--;
	else
		p->include_depth--;
	scope_close(p);
	p->source = s->below;
	s->below = p->spare_source;
	p->spare_source = s;
}

void sources_release(struct pov *p)
{
	for (struct mapping *m = p->mappings; m; m = m->next) {
		if (m->base)
			munmap(m->base, m->size);
	}
}

/* -1: not there. Devices and folders count as not there. */
static int open_plain(const char *path, size_t *size)
{
	struct stat st;
	int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);

	if (fd < 0)
		return -1;
	if (fstat(fd, &st) || !S_ISREG(st.st_mode) || (uint64_t)st.st_size > SIZE_MAX / 2) {
		close(fd);
		return -1;
	}
	*size = (size_t)st.st_size;
	return fd;
}

/* "folder" + "name" in the scene's arena, since messages show it. */
char *source_join(struct pov *p, const char *folder, const char *name)
{
	size_t a = strlen(folder), b = strlen(name);
	bool slash = a && folder[a - 1] != '/';
	char *path = arena_alloc(&p->scene->arena, a + b + 2);

	if (!path) {
		pov_no_memory(p);
		return NULL;
	}
	memcpy(path, folder, a);
	if (slash)
		path[a] = '/';
	memcpy(path + a + slash, name, b + 1);
	return path;
}

static int try_folder(struct pov *p, const char *folder, const char *name, char **path, size_t *size)
{
	*path = source_join(p, folder, name);
	return *path ? open_plain(*path, size) : -1;
}

/* The including file's folder, the scene's, -L, the installed POV-Ray's. */
static int find_file(struct pov *p, const char *name, char **path, size_t *size)
{
	const struct read_options *o = p->options;
	int fd;

	if (name[0] == '/')
		return try_folder(p, "", name, path, size);
	fd = try_folder(p, p->source->folder, name, path, size);
	if (fd < 0)
		fd = try_folder(p, p->scene_folder, name, path, size);
	for (uint32_t i = 0; fd < 0 && i < o->include_dir_count; i++)
		fd = try_folder(p, o->include_dirs[i], name, path, size);
	for (size_t i = 0; fd < 0 && !o->no_system_includes &&
		    i < sizeof(system_folder) / sizeof(system_folder[0]); i++)
		fd = try_folder(p, system_folder[i], name, path, size);
	return fd;
}

bool source_exists(struct pov *p, const char *name)
{
	size_t size;
	char *path;
	int fd = find_file(p, name, &path, &size);

	if (fd >= 0)
		close(fd);
	return fd >= 0;
}

char *pov_find_file(struct pov *p, const char *name)
{
	size_t size;
	char *path;
	int fd = find_file(p, name, &path, &size);

	if (fd < 0)
		return NULL;
	close(fd);
	return path;
}

static const char *folder_of(struct pov *p, const char *path)
{
	const char *slash = strrchr(path, '/');
	char *folder;

	if (!slash)
		return "";
	folder = pov_alloc(p, (size_t)(slash - path) + 2);
	if (folder)
		memcpy(folder, path, (size_t)(slash - path) + 1);
	return folder;
}

static char *keep_text(struct pov *p, const char *text)
{
	size_t n = strlen(text);
	char *copy = pov_alloc(p, n + 1);

	if (copy)
		memcpy(copy, text, n);
	return copy;
}

/* Takes fd. NULL: reported. */
static struct mapping *map_file(struct pov *p, const char *name, char *path, int fd, size_t size,
				const struct diag_pos *pos)
{
	struct mapping *m = pov_alloc(p, sizeof(*m));

	if (m) {
		*m = (struct mapping){ .name = keep_text(p, name), .from = keep_text(p, p->source->folder),
				       .path = path, .folder = folder_of(p, path), .size = size };
		if (size)
			m->base = mmap(NULL, size, PROT_READ, MAP_PRIVATE, fd, 0);
		if (m->base == MAP_FAILED) {
			pov_fail_at(p, pos, "\"%s\" cannot be read: %s", path, strerror(errno));
			m->base = NULL;
		}
		m->next = p->mappings;
		p->mappings = m;
		p->token_limit += size;
	}
	close(fd);
	return p->failed ? NULL : m;
}

static struct mapping *known(const struct pov *p, const char *name)
{
	for (struct mapping *m = p->mappings; m; m = m->next) {
		if (!strcmp(m->name, name) && !strcmp(m->from, p->source->folder))
			return m;
	}
	return NULL;
}

struct mapping *source_map(struct pov *p, const char *what, const char *name, const struct diag_pos *pos)
{
	struct mapping *m = known(p, name);
	size_t size = 0;
	char *path;
	int fd;

	if (m)
		return m;
	fd = find_file(p, name, &path, &size);
	if (fd >= 0)
		return map_file(p, name, path, fd, size, pos);
	pov_fail_at(p, pos, "%s \"%s\" was not found (looked in the including file's and the scene's folder, -L "
		    "folders%s)", what, name, p->options->no_system_includes ? "" : " and POV-Ray's include folder");
	return NULL;
}

bool source_include(struct pov *p, const char *name, const struct diag_pos *pos)
{
	struct mapping *m;

	if (p->include_depth >= p->limit.include_depth) {
		pov_limit(p, pos, "include_depth", p->limit.include_depth,
			  "files include each other too deeply, perhaps in a circle");
		return false;
	}
	m = source_map(p, "include file", name, pos);
	if (!m || !pov_charge(p, 32) ||
	    !source_push_text(p, m->path, m->folder, m->base ? m->base : "", m->size))
		return false;
	p->include_depth++;
	return true;
}
