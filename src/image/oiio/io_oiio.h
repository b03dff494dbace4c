/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The border between the library and its OpenImageIO module: plain C, no exception crosses it.
 *
 * OpenImageIO brings some 250 shared libraries and most of a second of start-up, so it is never
 * linked to the library, but loaded when a picture is neither PNG, EXR, PPM nor PFM. The module
 * exports the one symbol below. Functions return 0, or 1 with a text in error.
 */
#ifndef ALIDADE_IMAGE_OIIO_IO_OIIO_H
#define ALIDADE_IMAGE_OIIO_IO_OIIO_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define IO_OIIO_ABI 2
#define IO_OIIO_SYMBOL "alidade_io_oiio"

struct io_oiio_header {
	uint64_t width, height, channels;
	uint32_t bits; /* of a stored sample: 8, 16 or 32 */
	int linear; /* light, not sRGB */
	const char *const *name; /* of the channels; valid during the call of take */
};

/* A texture's picture: 1 to 4 channels of 8 or 16 bits or floats (bits 32), not multiplied by alpha
 * unless that is how the file has them. */
struct io_oiio_raw {
	uint64_t width, height;
	uint32_t channels, bits;
	int linear, premultiplied;
	const char *format; /* OpenImageIO's name of it; valid during the call of take */
};

struct io_oiio_picture {
	uint32_t width, height, channels; /* 1 to 4 */
	uint32_t bits;
	int linear;
	const float *pixel; /* as the file shall hold it; alpha is last and multiplied in */
	const char *const *key, *const *value; /* notes */
	uint32_t notes;
};

struct io_oiio {
	uint32_t abi, size; /* IO_OIIO_ABI, sizeof(struct io_oiio) */
	/* Colour comes multiplied by alpha. take() gives the memory for the samples, or NULL, when
	 * it has told why, and read() ends with 2. */
	int (*read)(const char *path, float *(*take)(void *arg, const struct io_oiio_header *),
		    void *arg, char *error, size_t error_size);
	/* The same for struct io_oiio_raw. */
	int (*read_raw)(const char *path, void *(*take)(void *arg, const struct io_oiio_raw *), void *arg,
			char *error, size_t error_size);
	/* Is there a writer for that ending? *linear: its files hold light, *alpha: and an alpha
	 * channel. bits 0 is set to what it usually stores. */
	int (*can_write)(const char *path, uint32_t *bits, int *linear, int *alpha, char *error,
			 size_t error_size);
	/* path: a file of the caller's with the right ending. Most formats leave it alone and give
	 * the file's bytes to put(), which writes and flushes them and returns 0, or else write()
	 * ends with 2: libraries that write themselves may overlook a full disk, or end the program
	 * over it. */
	int (*write)(const char *path, const struct io_oiio_picture *,
		     int (*put)(void *arg, const void *bytes, size_t n), void *arg, char *error,
		     size_t error_size);
};

#ifdef __cplusplus
}
#endif

#endif
