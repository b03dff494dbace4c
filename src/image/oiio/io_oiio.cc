/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The OpenImageIO module: see io_oiio.h. The one file in C++.
 */
#include "io_oiio.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace
{

int fail(char *error, size_t size, const std::string &text)
{
	std::string line = text.empty() ? "OpenImageIO gave no reason" : text;

	/* One line, whatever the library says. */
	while (!line.empty() && line.back() == '\n')
		line.pop_back();
	for (char &c : line)
		c = c == '\n' ? ' ' : c;
	std::snprintf(error, size, "%s", line.c_str());
	return 1;
}

/* Runs f, which returns like the functions of the border, and lets no exception out. */
template <class F> int guarded(char *error, size_t size, F f) noexcept
{
	try {
		return f();
	} catch (const std::exception &e) {
		std::snprintf(error, size, "%s", e.what());
	} catch (...) {
		std::snprintf(error, size, "OpenImageIO failed without a reason");
	}
	return 1;
}

bool is_linear(const OIIO::ImageSpec &spec)
{
	std::string space = spec.get_string_attribute("oiio:ColorSpace");

	if (!space.empty())
		return OIIO::Strutil::iequals(space, "linear") ||
		       OIIO::Strutil::iequals(space, "scene_linear");
	return spec.format.is_floating_point();
}

uint32_t stored_bits(const OIIO::ImageSpec &spec)
{
	size_t bytes = spec.format.size();

	return bytes <= 1 ? 8 : bytes == 2 ? 16 : 32;
}

int do_read(const char *path, float *(*take)(void *, const io_oiio_header *), void *arg,
	    char *error, size_t size)
{
	std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
	std::vector<const char *> name;
	io_oiio_header h = {};
	float *pixel;

	if (!in)
		return fail(error, size, OIIO::geterror());
	const OIIO::ImageSpec &spec = in->spec();
	if (spec.deep || spec.depth > 1)
		return fail(error, size, "deep and three-dimensional pictures are not supported");
	if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
		return fail(error, size, "the picture has no pixels");
	for (const std::string &s : spec.channelnames)
		name.push_back(s.c_str());
	name.resize(static_cast<size_t>(spec.nchannels), "");
	h.width = static_cast<uint64_t>(spec.width);
	h.height = static_cast<uint64_t>(spec.height);
	h.channels = static_cast<uint64_t>(spec.nchannels);
	h.bits = stored_bits(spec);
	h.linear = is_linear(spec);
	h.name = name.data();
	pixel = take(arg, &h);
	if (!pixel)
		return 2;
	if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixel))
		return fail(error, size, in->geterror());
	return 0;
}

/* Those of colour and alpha, which come first in all formats that a scene's textures are in. */
uint32_t raw_channels(const OIIO::ImageSpec &spec)
{
	int n = spec.nchannels;

	if (n <= 2)
		return n == 2 && spec.alpha_channel == 1 ? 2 : 1;
	return n >= 4 && spec.alpha_channel == 3 ? 4 : 3;
}

int do_read_raw(const char *path, void *(*take)(void *, const io_oiio_raw *), void *arg, char *error,
		size_t size)
{
	OIIO::ImageSpec wish;
	std::unique_ptr<OIIO::ImageInput> in;
	io_oiio_raw h = {};
	void *sample;

	wish.attribute("oiio:UnassociatedAlpha", 1);
	in = OIIO::ImageInput::open(path, &wish);
	if (!in)
		return fail(error, size, OIIO::geterror());
	const OIIO::ImageSpec &spec = in->spec();
	if (spec.deep || spec.depth > 1)
		return fail(error, size, "deep and three-dimensional pictures are not supported");
	if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
		return fail(error, size, "the picture has no pixels");
	h.width = static_cast<uint64_t>(spec.width);
	h.height = static_cast<uint64_t>(spec.height);
	h.channels = raw_channels(spec);
	h.bits = stored_bits(spec);
	if (spec.format.is_floating_point())
		h.bits = 32;
	h.linear = is_linear(spec);
	h.premultiplied = spec.alpha_channel >= 0 && !spec.get_int_attribute("oiio:UnassociatedAlpha");
	h.format = in->format_name();
	sample = take(arg, &h);
	if (!sample)
		return 2;
	if (!in->read_image(0, 0, 0, static_cast<int>(h.channels),
			    h.bits == 8	 ? OIIO::TypeDesc::UINT8 :
			    h.bits == 16 ? OIIO::TypeDesc::UINT16 :
					   OIIO::TypeDesc::FLOAT,
			    sample))
		return fail(error, size, in->geterror());
	return 0;
}

int do_can_write(const char *path, uint32_t *bits, int *linear, int *alpha, char *error,
		 size_t size)
{
	std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path);
	std::string format;

	if (!out)
		return fail(error, size, OIIO::geterror());
	format = out->format_name();
	*alpha = out->supports("alpha");
	if (!*bits)
		*bits = format == "hdr" || format == "rla" ? 32 : 8;
	if (*bits != 8 && *bits != 16 && *bits != 32)
		return fail(error, size, "8, 16 or 32 bits can be asked for");
	if (format == "hdr" && *bits != 32)
		return fail(error, size, "this format stores light only: ask for 32 bits");
	if (*bits != 8 && format != "hdr" && format != "tiff" && format != "openexr" &&
	    format != "rla" && format != "dpx" && format != "zfile" && format != "jpeg2000")
		return fail(error, size, "this format stores 8 bits");
	*linear = *bits == 32;
	return 0;
}

/* Some writers don't look whether their bytes reach the disk, others are broken: read it again. */
bool reads_back(const char *path, const OIIO::ImageSpec &spec)
{
	std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
	std::vector<unsigned char> row;

	if (!in)
		return false;
	const OIIO::ImageSpec back = in->spec();
	if (back.width != spec.width || back.height != spec.height)
		return false;
	row.resize(static_cast<size_t>(back.width) * static_cast<size_t>(back.height) *
		   static_cast<size_t>(back.nchannels));
	return in->read_image(0, 0, 0, back.nchannels, OIIO::TypeDesc::UINT8, row.data());
}

int do_write(const char *path, const io_oiio_picture *p, int (*put)(void *, const void *, size_t),
	     void *arg, char *error, size_t size)
{
	std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path);
	OIIO::ImageSpec spec(static_cast<int>(p->width), static_cast<int>(p->height),
			     static_cast<int>(p->channels),
			     p->bits == 8  ? OIIO::TypeDesc::UINT8 :
			     p->bits == 16 ? OIIO::TypeDesc::UINT16 :
					     OIIO::TypeDesc::FLOAT);
	OIIO::Filesystem::IOVecOutput memory;
	bool whole;

	if (!out)
		return fail(error, size, OIIO::geterror());
	spec.attribute("oiio:ColorSpace", p->linear ? "Linear" : "sRGB");
	spec.attribute("CompressionQuality", 95);
	for (uint32_t i = 0; i < p->notes; i++)
		spec.attribute(p->key[i], p->value[i]);
	/* TIFF through memory comes out without its directory (2.4.7). */
	whole = std::strcmp(out->format_name(), "tiff") && out->supports("ioproxy") &&
		out->set_ioproxy(&memory);
	if (!out->open(path, spec) || !out->write_image(OIIO::TypeDesc::FLOAT, p->pixel) ||
	    !out->close())
		return fail(error, size, out->geterror());
	out.reset();
	if (whole && put(arg, memory.buffer().data(), memory.buffer().size()))
		return 2;
	if (!reads_back(path, spec))
		return fail(error, size,
			    "what was written cannot be read again: is the disk full?");
	return 0;
}

int io_read(const char *path, float *(*take)(void *, const io_oiio_header *), void *arg,
	    char *error, size_t size)
{
	return guarded(error, size, [=] { return do_read(path, take, arg, error, size); });
}

int io_read_raw(const char *path, void *(*take)(void *, const io_oiio_raw *), void *arg, char *error,
		size_t size)
{
	return guarded(error, size, [=] { return do_read_raw(path, take, arg, error, size); });
}

int io_can_write(const char *path, uint32_t *bits, int *linear, int *alpha, char *error,
		 size_t size)
{
	return guarded(error, size,
		       [=] { return do_can_write(path, bits, linear, alpha, error, size); });
}

int io_write(const char *path, const io_oiio_picture *p, int (*put)(void *, const void *, size_t),
	     void *arg, char *error, size_t size)
{
	return guarded(error, size, [=] { return do_write(path, p, put, arg, error, size); });
}

} // namespace

extern "C" {
extern __attribute__((visibility("default"))) const struct io_oiio alidade_io_oiio;
const struct io_oiio alidade_io_oiio = { IO_OIIO_ABI, sizeof(struct io_oiio), io_read, io_read_raw,
					 io_can_write, io_write };
}
