/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A scene file's bytes, and which reader they are for.
 */
#include <config.h>

#include "read/read.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "read/ini.h"
#include "read/pov/parser.h"

struct text {
	const char *name; /* for messages */
	char *bytes;
	size_t size;
	bool mapped, kept; /* kept: somebody else's */
};

static void text_release(struct text *t)
{
	if (t->kept)
		return;
	if (t->mapped)
		munmap(t->bytes, t->size);
	else
		mem_free(t->bytes);
}

/* What cannot be mapped: standard input, a pipe. */
static enum status slurp(int fd, struct text *t, struct mem_book *book, struct diag *diag)
{
	struct diag_pos pos = { t->name, 0, 0 };
	size_t room = 1 << 16;
	ssize_t n;
	char *bigger;

	t->bytes = mem_alloc(book, "scene file", room);
	while (t->bytes) {
		if (t->size == room) {
			room *= 2;
			bigger = mem_realloc(t->bytes, room);
			if (!bigger)
				break;
			t->bytes = bigger;
		}
		n = read(fd, t->bytes + t->size, room - t->size);
		if (n == 0)
			return STATUS_OK;
		if (n < 0 && errno != EINTR)
			return diag_fail(diag, STATUS_SCENE, &pos, "cannot be read: %s", strerror(errno));
		if (n > 0)
			t->size += (size_t)n;
	}
	return diag_no_memory(diag, "the scene file", room);
}

static enum status standard_input(struct text *t, struct read_stdin *keep, struct mem_book *book,
				  struct diag *diag)
{
	enum status st = STATUS_OK;

	if (!keep)
		return slurp(STDIN_FILENO, t, book, diag);
	if (keep->bytes) {
		t->bytes = keep->bytes;
		t->size = keep->size;
	} else {
		st = slurp(STDIN_FILENO, t, book, diag);
		keep->bytes = t->bytes;
		keep->size = t->size;
	}
	t->kept = true;
	return st;
}

void read_stdin_release(struct read_stdin *s)
{
	mem_free(s->bytes);
	s->bytes = NULL;
}

static enum status text_load(const char *path, struct text *t, struct read_stdin *keep,
			     struct mem_book *book, struct diag *diag)
{
	struct diag_pos pos = { t->name, 0, 0 };
	enum status st = STATUS_OK;
	struct stat info;
	int fd;

	if (!strcmp(path, "-"))
		return standard_input(t, keep, book, diag);
	fd = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
	if (fd < 0 || fstat(fd, &info)) {
		st = diag_fail(diag, STATUS_SCENE, &pos, "the scene cannot be opened: %s%s", strerror(errno),
			       frames_has_place(path) ? "; -f says which frames #### stands for" : "");
	} else if (S_ISDIR(info.st_mode)) {
		st = diag_fail(diag, STATUS_SCENE, &pos, "is a folder, not a scene file");
	} else if (!S_ISREG(info.st_mode)) {
		st = slurp(fd, t, book, diag);
	} else if (info.st_size) {
		t->bytes = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
		t->mapped = t->bytes != MAP_FAILED;
		if (t->mapped) {
			t->size = (size_t)info.st_size;
		} else {
			t->bytes = NULL;
			st = diag_fail(diag, STATUS_SCENE, &pos, "cannot be read: %s", strerror(errno));
		}
	}
	if (fd >= 0)
		close(fd);
	return st;
}

static bool is_blank(const struct text *t)
{
	for (size_t i = 0; i < t->size; i++) {
		if (!strchr(" \t\r\n\f\v", t->bytes[i]) || !t->bytes[i])
			return false;
	}
	return true;
}

/* What is plainly no text of ours: said at once instead of a syntax error in line 1. */
static enum status refuse(const struct text *t, struct diag *diag)
{
	struct diag_pos pos = { t->name, 0, 0 };
	size_t head = t->size < 512 ? t->size : 512;

	if (is_blank(t))
		return diag_fail(diag, STATUS_SCENE, &pos, "the file is empty");
	if (t->size >= 4 && !memcmp(t->bytes, "glTF", 4))
		return diag_fail(diag, STATUS_SCENE, &pos, "glTF scenes are not supported yet; export the "
				 "scene with Blender's POV-Ray add-on");
	if (memchr(t->bytes, 0, head))
		return diag_fail(diag, STATUS_SCENE, &pos, "is a binary file; POV-Ray scenes (.pov) and "
				 "their .ini files can be read");
	return STATUS_OK;
}

/* POV-Ray's camera when a scene has none (manual 3.4.2). */
static void default_camera(struct scene *scene)
{
	scene->camera = (struct camera){
		.kind = CAMERA_PERSPECTIVE, .direction = { 0, 0, 1 }, .right = { 1.33, 0, 0 },
		.up = { 0, 1, 0 }
	};
}

static enum status read_path(const char *path, const struct read_options *, struct scene *,
			     struct read_job *, struct diag *);

static enum status read_numbered(const char *pattern, const struct read_options *o, struct scene *scene,
				 struct diag *diag)
{
	size_t size = strlen(pattern) + 16;
	char *path = arena_alloc(&scene->arena, size);

	if (!path || !frames_name(path, size, pattern, o->frame.number, o->frame_digits, false))
		return diag_no_memory(diag, "the scene's name", size);
	return read_path(path, o, scene, NULL, diag);
}

/* The scene that an .ini names, with its sizes and declarations. */
static enum status read_ini(const char *path, const struct text *t, const struct read_options *options,
			    struct scene *scene, struct read_job *job, struct diag *diag)
{
	struct read_job own = { .set = 0 };
	struct read_options o = *options;
	struct ini ini = { .job = job ? job : &own };
	enum status st;

	*ini.job = own;
	st = ini_read(&ini, path, t->bytes, t->size, options, scene, diag);
	if (st)
		return st;
	if (!o.width && ini.job->set & READ_JOB_WIDTH)
		o.width = ini.job->width;
	if (!o.height && ini.job->set & READ_JOB_HEIGHT)
		o.height = ini.job->height;
	o.defines = ini.define;
	o.define_count = ini.define_count;
	o.include_dirs = ini.folder;
	o.include_dir_count = ini.folder_count;
	if (o.frame_digits && frames_has_place(ini.input))
		return read_numbered(ini.input, &o, scene, diag);
	/* Its name stands in the scene's arena. */
	return read_path(ini.input, &o, scene, NULL, diag);
}

static enum status read_path(const char *path, const struct read_options *options, struct scene *scene,
			     struct read_job *job, struct diag *diag)
{
	struct text t = { .name = strcmp(path, "-") ? path : "standard input" };
	enum status st = text_load(path, &t, options->standard_input, scene->book, diag);

	if (!st)
		st = refuse(&t, diag);
	if (!st && ini_recognise(t.bytes, t.size)) {
		if (job)
			st = read_ini(path, &t, options, scene, job, diag);
		else
			st = diag_fail(diag, STATUS_SCENE, &(struct diag_pos){ t.name, 0, 0 },
				       "is an .ini file, but a scene was expected");
	} else if (!st) {
		st = pov_read(t.name, t.bytes, t.size, options, scene, diag);
	}
	text_release(&t);
	return st;
}

enum status read_scene(const char *path, const struct read_options *options, struct scene *scene,
		       struct read_job *job, struct diag *diag)
{
	struct read_job own = { .set = 0 };
	enum status st;
	char *name;

	if (!job)
		job = &own;
	*job = own;
	name = arena_strdup(&scene->arena, path);
	if (!name)
		return diag_no_memory(diag, "the scene's name", strlen(path));
	scene->name = name;
	st = read_path(name, options, scene, job, diag);
	if (!st && !scene->has_camera)
		default_camera(scene);
	return st;
}

void read_job_peek(const char *path, const struct read_options *options, struct mem_book *book,
		   struct read_job *job)
{
	struct text t = { .name = path };
	struct diag silent = { .sink = NULL };
	struct ini ini = { .job = job };
	struct scene scratch;

	*job = (struct read_job){ .set = 0 };
	if (!strcmp(path, "-") && !options->standard_input)
		return;
	scene_init(&scratch, book);
	if (!text_load(path, &t, options->standard_input, book, &silent) && !refuse(&t, &silent) &&
	    ini_recognise(t.bytes, t.size))
		ini_read(&ini, path, t.bytes, t.size, options, &scratch, &silent);
	text_release(&t);
	scene_release(&scratch);
	job->output = NULL;
}
