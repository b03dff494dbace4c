/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The border between the library and its OpenImageIO module: plain C, no exception crosses it.
 *
 * OpenImageIO brings some 250 shared libraries and most of a second of start-up, so it is never linked to
 * the library, but loaded when a picture is neither PNG, EXR, PPM nor PFM. The module exports the one symbol
 * below. Functions return 0, or 1 with a text in error.
 */
#ifndef ALIDADE_IMAGE_OIIO_IO_OIIO_H
#define ALIDADE_IMAGE_OIIO_IO_OIIO_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define IO_OIIO_ABI 1
#define IO_OIIO_SYMBOL "alidade_io_oiio"

struct io_oiio_header {
	uint64_t width, height, channels;
	uint32_t bits; /* of a stored sample: 8, 16 or 32 */
	int linear; /* light, not sRGB */
	const char *const *name; /* of the channels; valid during the call of take */
};

struct io_oiio {
	uint32_t abi, size; /* IO_OIIO_ABI, sizeof(struct io_oiio) */
	/* Colour comes multiplied by alpha. take() gives the memory for the samples, or NULL, when it
	 * has told why, and read() ends with 2. */
	int (*read)(const char *path, float *(*take)(void *arg, const struct io_oiio_header *), void *arg,
		    char *error, size_t error_size);
	/* Is there a writer for that ending? *linear: its files hold light, *alpha: and an alpha channel. bits 0
	 * is set to what it usually stores. */
	int (*can_write)(const char *path, uint32_t *bits, int *linear, int *alpha, char *error,
			 size_t error_size);
	/* channels: 1 to 4. pixel: as the file shall hold it. Alpha, if there, is last and multiplied in. */
	int (*write)(const char *path, uint32_t width, uint32_t height, uint32_t channels, uint32_t bits,
		     int linear, const float *pixel, const char *const *key, const char *const *value,
		     uint32_t notes, char *error, size_t error_size);
};

#ifdef __cplusplus
}
#endif

#endif
