/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/out.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* "folder/" of path, "" for the working folder. */
static size_t folder_length(const char *path)
{
	const char *slash = strrchr(path, '/');

	return slash ? (size_t)(slash - path) + 1 : 0;
}

static char *folder_of(const char *path)
{
	size_t n = folder_length(path);

	return n ? strndup(path, n > 1 ? n - 1 : 1) : strdup(".");
}

/* A link is followed, so that the file it names is replaced and the link stays. */
static char *follow(const char *path)
{
	struct stat st;
	char *real = NULL;

	if (!lstat(path, &st) && S_ISLNK(st.st_mode))
		real = realpath(path, NULL);
	return real ? real : strdup(path);
}

static enum status check_folder(const char *final, const struct diag_pos *pos, struct diag *diag)
{
	char *folder = folder_of(final);
	enum status st = STATUS_OK;
	struct stat info;

	if (!folder)
		return diag_no_memory(diag, "a file name", strlen(final));
	if (stat(folder, &info))
		st = diag_fail(diag, STATUS_FAILED, pos, "cannot write to the folder %s: %s",
			       folder, strerror(errno));
	else if (!S_ISDIR(info.st_mode))
		st = diag_fail(diag, STATUS_FAILED, pos, "cannot write: %s is not a folder",
			       folder);
	else if (access(folder, W_OK | X_OK))
		st = diag_fail(diag, STATUS_FAILED, pos, "cannot write to the folder %s: %s",
			       folder, strerror(errno));
	free(folder);
	return st;
}

/* direct: what stands there is no regular file. mode: of the file that stands there, 0 if none. */
static enum status check_target(const char *final, const struct diag_pos *pos, struct diag *diag,
				bool *direct, mode_t *mode)
{
	struct stat st;

	*direct = false;
	*mode = 0;
	if (!*final)
		return diag_fail(diag, STATUS_FAILED, NULL, "the name of the output file is empty");
	if (stat(final, &st)) {
		if (errno != ENOENT)
			return diag_fail(diag, STATUS_FAILED, pos, "cannot write: %s",
					 strerror(errno));
		return check_folder(final, pos, diag);
	}
	if (S_ISDIR(st.st_mode))
		return diag_fail(diag, STATUS_FAILED, pos,
				 "cannot write: this is a folder; name a file in it");
	if (access(final, W_OK))
		return diag_fail(diag, STATUS_FAILED, pos, "cannot replace the file: %s",
				 strerror(errno));
	*direct = !S_ISREG(st.st_mode);
	*mode = st.st_mode & 07777;
	return *direct ? STATUS_OK : check_folder(final, pos, diag);
}

enum status image_out_check(const char *path, struct diag *diag)
{
	struct diag_pos pos = { .file = path };
	enum status st;
	bool direct;
	mode_t mode;
	char *final;

	if (!strncmp(path, "-.", 2) || !strcmp(path, "-")) {
		if (isatty(STDOUT_FILENO))
			return diag_fail(
				diag, STATUS_FAILED, NULL,
				"not writing a picture to the terminal: redirect standard output");
		return STATUS_OK;
	}
	final = follow(path);
	if (!final)
		return diag_no_memory(diag, "a file name", strlen(path));
	st = check_target(final, &pos, diag, &direct, &mode);
	free(final);
	return st;
}

/* Makes a new file beside final; the descriptor, or -1 and errno. */
static int open_temporary(struct image_out *o, const char *ending, mode_t mode)
{
	size_t folder = folder_length(o->final);
	int fd = -1;

	for (unsigned int i = 0; i < 1000; i++) {
		if (asprintf(&o->temporary, "%.*s.alidade-%ld-%u%s", (int)folder, o->final,
			     (long)getpid(), i, ending) < 0) {
			o->temporary = NULL;
			errno = ENOMEM;
			return -1;
		}
		fd = open(o->temporary, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
		if (fd >= 0 && mode)
			(void)fchmod(fd, mode & 0777);
		if (fd >= 0 || errno != EEXIST)
			break;
		free(o->temporary);
		o->temporary = NULL;
	}
	if (fd < 0) {
		free(o->temporary);
		o->temporary = NULL;
	}
	return fd;
}

static enum status open_standard(struct image_out *o)
{
	int fd;

	if (image_out_check("-", o->diag))
		return STATUS_FAILED;
	fd = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
	o->standard = true;
	o->file = fd < 0 ? NULL : fdopen(fd, "wb");
	if (o->file)
		return STATUS_OK;
	if (fd >= 0)
		close(fd);
	return diag_fail(o->diag, STATUS_FAILED, NULL, "cannot write to standard output: %s",
			 strerror(errno));
}

enum status image_out_open(struct image_out *o, const char *path, const char *ending,
			   struct diag *diag)
{
	struct diag_pos pos = { .file = path };
	enum status st;
	bool direct;
	mode_t mode;
	int fd, error;

	*o = (struct image_out){ .path = path, .diag = diag };
	if (!strncmp(path, "-.", 2) || !strcmp(path, "-"))
		return open_standard(o);
	o->final = follow(path);
	if (!o->final)
		return diag_no_memory(diag, "a file name", strlen(path));
	st = check_target(o->final, &pos, diag, &direct, &mode);
	if (st) {
		image_out_drop(o);
		return st;
	}
	fd = direct ? open(o->final, O_WRONLY | O_NOCTTY | O_CLOEXEC)
		    : open_temporary(o, ending, mode);
	o->file = fd < 0 ? NULL : fdopen(fd, "wb");
	if (o->file)
		return STATUS_OK;
	error = errno;
	if (fd >= 0)
		close(fd);
	image_out_drop(o);
	return diag_fail(diag, STATUS_FAILED, &pos, "cannot write: %s", strerror(error));
}

enum status image_out_failed(struct image_out *o)
{
	struct diag_pos pos = { .file = o->standard ? "standard output" : o->path };
	int error = errno;

	return diag_fail(o->diag, STATUS_FAILED, &pos, "cannot write the picture: %s%s",
			 error ? strerror(error) : "the stream failed",
			 o->temporary ? "; what stood there before, if anything, is unchanged"
				      : "");
}

/* The file's bytes are on the disk before it gets its name, so that no power cut leaves half a picture under it. The
 * name itself may be lost to one: then what stood there before is there, whole. Waiting for the folder too takes as
 * long as writing the picture. */
enum status image_out_finish(struct image_out *o)
{
	bool ok;

	errno = 0;
	ok = !ferror(o->file) && !fflush(o->file) && (!o->temporary || !fsync(fileno(o->file)));
	if (!ok) {
		(void)image_out_failed(o);
		image_out_drop(o);
		return STATUS_FAILED;
	}
	ok = !fclose(o->file);
	o->file = NULL;
	if (!ok || (o->temporary && rename(o->temporary, o->final))) {
		(void)image_out_failed(o);
		image_out_drop(o);
		return STATUS_FAILED;
	}
	free(o->temporary);
	o->temporary = NULL;
	image_out_drop(o);
	return STATUS_OK;
}

void image_out_drop(struct image_out *o)
{
	if (o->file)
		fclose(o->file);
	if (o->temporary)
		(void)unlink(o->temporary);
	free(o->temporary);
	free(o->final);
	o->file = NULL;
	o->temporary = o->final = NULL;
}
