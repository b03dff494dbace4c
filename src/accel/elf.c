/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * System V gABI, chapters 4 (object files) and 5 (program loading).
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "accel/elf.h"

#ifdef __ELF__
#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdbool.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#define NATIVE_CLASS (sizeof(void *) == 8 ? ELFCLASS64 : ELFCLASS32)

struct image {
	const unsigned char *at;
	uint64_t size;
};

/* n things of one size at an offset; NULL if the file ends before. Unaligned ones are refused too. */
static const void *image_part(const struct image *f, uint64_t at, uint64_t n, uint64_t each)
{
	if (at > f->size || n > (f->size - at) / each || at % 4)
		return NULL;
	return f->at + at;
}

static const char *check_segments(const struct image *f, const ElfW(Ehdr) *eh)
{
	const ElfW(Phdr) *ph = image_part(f, eh->e_phoff, eh->e_phnum, sizeof(*ph));

	if (!ph)
		return "the file is cut short";
	for (unsigned i = 0; i < eh->e_phnum; i++) {
		if (ph[i].p_filesz > f->size || ph[i].p_offset > f->size - ph[i].p_filesz)
			return "the file is cut short";
	}
	return NULL;
}

/* The file offset of a virtual address, or UINT64_MAX. */
static uint64_t offset_of(const struct image *f, const ElfW(Ehdr) *eh, uint64_t address, uint64_t bytes)
{
	const ElfW(Phdr) *ph = image_part(f, eh->e_phoff, eh->e_phnum, sizeof(*ph));

	for (unsigned i = 0; ph && i < eh->e_phnum; i++) {
		if (ph[i].p_type == PT_LOAD && address >= ph[i].p_vaddr &&
		    address - ph[i].p_vaddr < ph[i].p_filesz &&
		    bytes <= ph[i].p_filesz - (address - ph[i].p_vaddr))
			return ph[i].p_offset + (address - ph[i].p_vaddr);
	}
	return UINT64_MAX;
}

static const ElfW(Sym) *find_symbol(const struct image *f, const ElfW(Shdr) *table,
				    const ElfW(Shdr) *names, const char *symbol)
{
	uint64_t n = table->sh_size / sizeof(ElfW(Sym));
	const ElfW(Sym) *sym = image_part(f, table->sh_offset, n, sizeof(*sym));
	uint64_t length = strlen(symbol) + 1;

	if (names->sh_size > f->size || names->sh_offset > f->size - names->sh_size)
		return NULL;
	for (uint64_t i = 0; sym && i < n; i++) {
		if (sym[i].st_shndx == SHN_UNDEF || sym[i].st_name > names->sh_size ||
		    length > names->sh_size - sym[i].st_name)
			continue;
		if (!memcmp(f->at + names->sh_offset + sym[i].st_name, symbol, length))
			return &sym[i];
	}
	return NULL;
}

/* The section headers may have been stripped; then dlsym() finds the symbol, or does not. */
static const char *peek_symbol(const struct image *f, const ElfW(Ehdr) *eh, const char *symbol,
			       struct elf_peek *out)
{
	const ElfW(Shdr) *sh = image_part(f, eh->e_shoff, eh->e_shnum, sizeof(*sh));
	const ElfW(Sym) *sym;
	uint64_t at;

	if (eh->e_shoff && !sh)
		return "the file is cut short";
	for (unsigned i = 0; sh && i < eh->e_shnum; i++) {
		if (sh[i].sh_type != SHT_DYNSYM || sh[i].sh_link >= eh->e_shnum)
			continue;
		sym = find_symbol(f, &sh[i], &sh[sh[i].sh_link], symbol);
		if (!sym)
			return "it does not export the symbol ald_accel_entry: it is no accelerator";
		if (ELF64_ST_TYPE(sym->st_info) == STT_FUNC)
			return "its ald_accel_entry is a function; it must be the structure itself";
		at = offset_of(f, eh, sym->st_value, 8);
		if (at == UINT64_MAX || at % 4)
			return "its ald_accel_entry holds no data";
		memcpy(&out->abi, f->at + at, 4);
		memcpy(&out->size, f->at + at + 4, 4);
		if (sym->st_size && out->size > sym->st_size)
			return "its ald_accel_entry is smaller than the size that it states";
		out->found = 1;
	}
	return NULL;
}

static const char *peek_image(const struct image *f, const char *symbol, struct elf_peek *out)
{
	const ElfW(Ehdr) *eh = (const void *)f->at;
	const char *fault;

	if (f->size < sizeof(*eh))
		return f->size >= SELFMAG && !memcmp(f->at, ELFMAG, SELFMAG) ?
			       "the file is cut short" :
			       "it is not a shared library";
	if (memcmp(eh->e_ident, ELFMAG, SELFMAG))
		return "it is not a shared library";
	if (eh->e_ident[EI_CLASS] != NATIVE_CLASS || eh->e_phentsize != sizeof(ElfW(Phdr)) ||
	    (eh->e_shnum && eh->e_shentsize != sizeof(ElfW(Shdr))))
		return "it was built for another kind of machine";
	if (eh->e_type != ET_DYN)
		return "it is not a shared library";
	fault = check_segments(f, eh);
	return fault ? fault : peek_symbol(f, eh, symbol, out);
}

const char *elf_peek_file(const char *path, const char *symbol, struct elf_peek *out)
{
	struct image f = { NULL, 0 };
	const char *fault = "it is empty";
	struct stat st;
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	void *map;

	*out = (struct elf_peek){ 0 };
	if (fd < 0)
		return strerror(errno);
	if (fstat(fd, &st)) {
		fault = strerror(errno);
	} else if (st.st_size > 0) {
		map = mmap(NULL, (size_t)st.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
		if (map == MAP_FAILED) {
			fault = strerror(errno);
		} else {
			f.at = map;
			f.size = (uint64_t)st.st_size;
			fault = peek_image(&f, symbol, out);
			munmap(map, f.size);
		}
	}
	close(fd);
	return fault;
}
#else
const char *elf_peek_file(const char *path, const char *symbol, struct elf_peek *out)
{
	(void)path;
	(void)symbol;
	*out = (struct elf_peek){ 0 };
	return NULL;
}
#endif
