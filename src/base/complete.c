/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Completion files for shells, from the table of options: bash(1) "Programmable Completion", zshcompsys(1)
 * "_arguments", and fish's complete(1). They need nothing but the shell itself.
 */
#include <config.h>

#include <string.h>

#include "base/options.h"

/* The accelerators are asked for when they are wanted: anyone may have added some. */
#define LIST_ACCELS "--list-accels 2>/dev/null"

/* Text inside single quotes, up to the first semicolon; what zsh's _arguments takes for punctuation gets
 * a backslash. */
static void quoted(FILE *out, const char *text, const char *escape)
{
	for (; *text && *text != ';'; text++) {
		if (*text == '\'')
			fputs("'\\''", out);
		else if (strchr(escape, *text))
			fprintf(out, "\\%c", *text);
		else
			fputc(*text, out);
	}
}

static void head(const struct option_program *p, FILE *out)
{
	fprintf(out, "# %s: made from the program's table of options; do not edit.\n", p->name);
}

/* The function is called after the program, with _ for what a name may not hold. */
static void function_name(const struct option_program *p, FILE *out)
{
	fputc('_', out);
	for (const char *s = p->name; *s; s++)
		fputc(*s == '-' ? '_' : *s, out);
}

static void bash_values(const struct option_program *p, const struct option_spec *o, FILE *out)
{
	switch (o->complete) {
	case COMPLETE_FILE:
		fputs("compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$cur\")", out);
		break;
	case COMPLETE_DIR:
		fputs("compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\")", out);
		break;
	case COMPLETE_WORDS:
		fprintf(out, "mapfile -t COMPREPLY < <(compgen -W '%s' -- \"$cur\")", o->words);
		break;
	case COMPLETE_ACCEL:
		fprintf(out,
			"mapfile -t COMPREPLY < <(compgen -W "
			"\"$(%s %s | sed -n 's/^\\([a-z][a-z0-9-]*\\).*/\\1/p')\" -- \"$cur\")",
			p->name, LIST_ACCELS);
		break;
	default:
		fputs("COMPREPLY=()", out);
	}
}

static void bash_cases(const struct option_program *p, enum option_arg takes, FILE *out)
{
	for (const struct option_spec *o = p->option; o->name; o++) {
		if (!o->help || o->takes != takes)
			continue;
		fputc('\t', out);
		if (takes == OPTION_ARG && o->key < OPTION_LONG_ONLY)
			fprintf(out, "-%c|", o->key);
		fprintf(out, takes == OPTION_ARG ? "--%s) " : "1--%s) ", o->name);
		bash_values(p, o, out);
		fputs("; return ;;\n", out);
	}
}

static void bash(const struct option_program *p, FILE *out)
{
	head(p, out);
	function_name(p, out);
	fputs("()\n{\n"
	      "\tlocal cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} equals=''\n"
	      "\tif [[ $cur == = ]]; then cur='' equals=1; fi\n"
	      "\tif [[ $prev == = ]]; then prev=${COMP_WORDS[COMP_CWORD-2]} equals=1; fi\n"
	      "\tcase $prev in\n",
	      out);
	bash_cases(p, OPTION_ARG, out);
	fputs("\tesac\n\tcase $equals$prev in\n", out);
	bash_cases(p, OPTION_MAYBE_ARG, out);
	fputs("\tesac\n\tif [[ $cur == -* ]]; then\n\t\tmapfile -t COMPREPLY < <(compgen -W '", out);
	for (const struct option_spec *o = p->option; o->name; o++) {
		if (o->help)
			fprintf(out, "--%s%s ", o->name, o->takes == OPTION_ARG ? "=" : "");
	}
	fputs("' -- \"$cur\")\n\t\t[[ ${COMPREPLY-} == *= ]] && compopt -o nospace\n\t\treturn\n\tfi\n"
	      "\tcompopt -o filenames\n\tmapfile -t COMPREPLY < <(",
	      out);
	if (p->endings) {
		fputs("compgen -d -- \"$cur\"; compgen -f -- \"$cur\" | grep -E '\\.(", out);
		for (const char *s = p->endings; *s; s++)
			fputc(*s == ' ' ? '|' : *s, out);
		fputs(")$'", out);
	} else {
		fputs("compgen -f -- \"$cur\"", out);
	}
	fputs(")\n}\ncomplete -F ", out);
	function_name(p, out);
	fprintf(out, " %s\n", p->name);
}

static void zsh_values(const struct option_program *p, const struct option_spec *o, FILE *out)
{
	fputs(o->takes == OPTION_MAYBE_ARG ? "::" : ":", out);
	quoted(out, o->arg, ":[]");
	switch (o->complete) {
	case COMPLETE_FILE:
		fputs(":_files", out);
		break;
	case COMPLETE_DIR:
		fputs(":_files -/", out);
		break;
	case COMPLETE_WORDS:
		fprintf(out, ":(%s)", o->words);
		break;
	case COMPLETE_ACCEL:
		fprintf(out, ":(${(f)\"$(%s %s | sed -n '\\''s/^\\([a-z][a-z0-9-]*\\).*/\\1/p'\\'')\"})",
			p->name, LIST_ACCELS);
		break;
	default:
		fputs(": ", out);
	}
}

static void zsh(const struct option_program *p, FILE *out)
{
	fprintf(out, "#compdef %s\n", p->name);
	head(p, out);
	fputs("_arguments -s -S", out);
	for (const struct option_spec *o = p->option; o->name; o++) {
		static const char *const mark_short[] = { "", "+", "-" };
		static const char *const mark_long[] = { "", "=", "=-" };

		if (!o->help)
			continue;
		fputs(" \\\n\t", out);
		if (o->key < OPTION_LONG_ONLY)
			fprintf(out, "\\*{-%c%s,--%s%s}'[", o->key, mark_short[o->takes], o->name,
				mark_long[o->takes]);
		else
			fprintf(out, "'*--%s%s[", o->name, mark_long[o->takes]);
		quoted(out, o->help, ":[]");
		fputc(']', out);
		if (o->takes)
			zsh_values(p, o, out);
		fputc('\'', out);
	}
	fputs(" \\\n\t'*:file:_files", out);
	if (p->endings) {
		fputs(" -g \"*.(", out);
		for (const char *s = p->endings; *s; s++)
			fputc(*s == ' ' ? '|' : *s, out);
		fputs(")(-.)\"", out);
	}
	fputs("'\n", out);
}

static void fish(const struct option_program *p, FILE *out)
{
	head(p, out);
	for (const struct option_spec *o = p->option; o->name; o++) {
		if (!o->help)
			continue;
		fprintf(out, "complete -c %s", p->name);
		if (o->key < OPTION_LONG_ONLY)
			fprintf(out, " -s %c", o->key);
		fprintf(out, " -l %s -d '", o->name);
		quoted(out, o->help, "");
		fputc('\'', out);
		if (o->takes == OPTION_ARG)
			fputs(o->complete == COMPLETE_FILE ? " -r -F" : " -x", out);
		if (o->complete == COMPLETE_DIR)
			fputs(" -a '(__fish_complete_directories)'", out);
		else if (o->complete == COMPLETE_WORDS)
			fprintf(out, " -a '%s'", o->words);
		else if (o->complete == COMPLETE_ACCEL)
			fprintf(out, " -a '(%s %s | string match -r \"^[a-z][a-z0-9-]*\")'", p->name,
				LIST_ACCELS);
		fputc('\n', out);
	}
	if (p->endings) {
		fprintf(out, "complete -c %s -k -f -a '(__fish_complete_suffix .", p->name);
		for (const char *s = p->endings; *s; s++)
			fputs(*s == ' ' ? " ." : (char[]){ *s, 0 }, out);
		fputs(")'\n", out);
	}
}

bool options_completion(const struct option_program *p, const char *shell, FILE *out)
{
	if (!strcmp(shell, "bash"))
		bash(p, out);
	else if (!strcmp(shell, "zsh"))
		zsh(p, out);
	else if (!strcmp(shell, "fish"))
		fish(p, out);
	else
		return false;
	return true;
}
