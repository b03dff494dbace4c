/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The report as one page that needs nothing else: no network, no fonts, no scripts but the dozen lines that
 * sort the table.
 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "trade.h"

static const char style[] =
	":root{color-scheme:light dark;--ink:#1c1f24;--paper:#fff;--soft:#5a6270;--line:#c9ced6;--fine:#eceff3;"
	"--box:#f4f6f9;--k0:#0072b2;--k1:#c4500a;--k2:#00845f;--k3:#a3487f;--k4:#9a6a00;--k5:#2b7fb8;--k6:#555e6b;"
	"--k7:#111}\n"
	"@media(prefers-color-scheme:dark){:root{--ink:#e6e9ee;--paper:#15181d;--soft:#a3acb9;--line:#454c57;"
	"--fine:#22262d;--box:#1e232a;--k0:#5ab4f0;--k1:#ff8f4d;--k2:#3ccf9e;--k3:#e79ac7;--k4:#f0bd4f;--k5:#8fd0ff;"
	"--k6:#9aa4b2;--k7:#fff}}\n"
	"body{font:15px/1.45 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:70rem;"
	"margin:1.5rem auto;padding:0 1rem}\n"
	"h1{font-size:1.4rem}h2{font-size:1.1rem;margin-top:1.8rem}p{margin:.4rem 0}\n"
	"code{font:13px ui-monospace,monospace;overflow-wrap:anywhere}\n"
	".rec{background:var(--box);border-left:4px solid var(--k2);padding:.5rem .8rem;margin:.6rem 0}\n"
	".rec.tied,.rec.unsure{border-color:var(--k4)}.rec.none{border-color:var(--k1)}\n"
	".soft{color:var(--soft)}.wide{overflow-x:auto}\n"
	"svg{width:100%;height:auto;font:11px system-ui,sans-serif;fill:var(--ink)}\n"
	"svg .grid{stroke:var(--line);stroke-width:.6;fill:none}svg .fine{stroke:var(--fine);fill:none}\n"
	"svg .frame{fill:none;stroke:var(--soft)}svg .band{fill:var(--fine)}svg .tick{fill:var(--soft)}\n"
	"svg .front{fill:none;stroke:var(--soft);stroke-width:1.5;stroke-dasharray:5 4}\n"
	"svg .bar{stroke:var(--c);stroke-width:1;opacity:.6;fill:none}svg .lead{stroke:var(--soft);stroke-width:.6}\n"
	"svg circle{fill:var(--paper);stroke:var(--c);stroke-width:1.6}svg .on circle{fill:var(--c)}\n"
	"svg .label{paint-order:stroke;stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}\n"
	".k0{--c:var(--k0)}.k1{--c:var(--k1)}.k2{--c:var(--k2)}.k3{--c:var(--k3)}.k4{--c:var(--k4)}"
	".k5{--c:var(--k5)}.k6{--c:var(--k6)}.k7{--c:var(--k7)}\n"
	"table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums}\n"
	"th,td{padding:.2rem .55rem;text-align:right;border-bottom:1px solid var(--fine);white-space:nowrap}\n"
	"th{cursor:pointer;border-bottom-color:var(--line);vertical-align:bottom}\n"
	"th:nth-child(2),td:nth-child(2){text-align:left}\n"
	"tr.front td{font-weight:600}tr.pick td{background:var(--box)}\n";

static const char script[] =
	"for(const h of document.querySelectorAll('th'))h.onclick=()=>{"
	"const i=h.cellIndex,b=h.closest('table').tBodies[0],d=h.dataset.d=h.dataset.d==='1'?'-1':'1',"
	"v=r=>{const c=r.cells[i],x=c.dataset.v;return x===undefined?c.textContent:x===''?Infinity:+x};"
	"[...b.rows].sort((p,q)=>{const x=v(p),y=v(q);return d*(x<y?-1:x>y?1:0)}).forEach(r=>b.append(r))}";

void trade_escape(FILE *out, const char *s)
{
	for (; *s; s++) {
		switch (*s) {
		case '&': fputs("&amp;", out); break;
		case '<': fputs("&lt;", out); break;
		case '>': fputs("&gt;", out); break;
		case '"': fputs("&quot;", out); break;
		default: fputc(*s, out);
		}
	}
}

static void put_element(FILE *out, const char *open, const char *text, const char *close)
{
	fputs(open, out);
	trade_escape(out, text);
	fputs(close, out);
}

static void put_verdicts(struct trade *t, FILE *out)
{
	static const char *const outcome[] = { "clear", "tied", "unsure", "none" };

	for (uint32_t i = 0; i < t->verdicts; i++) {
		const struct trade_verdict *v = &t->verdict[i];
		const char *more = trade_outcome_text(t, v), *again = trade_confirm_text(t, v);
		const char *caution = v->pick ? trade_caution_text(t, v->pick) : NULL;

		fprintf(out, "<div class=\"rec %s\">", outcome[v->outcome]);
		put_element(out, "<p>", trade_verdict_text(t, v), "</p>");
		if (more)
			put_element(out, "<p class=\"soft\">", more, "</p>");
		if (caution)
			put_element(out, "<p><strong>", caution, "</strong></p>");
		if (again)
			put_element(out, "<p class=\"soft\">", again, "</p>");
		if (v->pick)
			put_element(out, "<p><code>", trade_command(t, v->pick), "</code></p>");
		fputs("</div>\n", out);
	}
}

static void put_head(struct trade *t, FILE *out)
{
	fputs("<table>\n<thead><tr><th>front</th><th>setting</th>", out);
	for (int v = 0; v < TRADE_VALUES; v++) {
		const struct trade_column *c = &trade_column[v];

		if (!trade_shown(t, (enum trade_value)v, true))
			continue;
		fputs("<th title=\"", out);
		trade_escape(out, c->help);
		fprintf(out, "\">%s%s%s</th>", c->title, *c->unit ? "<br>" : "", c->unit);
		if (v == (int)t->clock)
			fputs("<th title=\"the interval of the median\">between</th>", out);
	}
	fputs("<th>runs</th></tr></thead>\n<tbody>\n", out);
}

static void put_cell(FILE *out, double value, const char *text)
{
	fputs("<td data-v=\"", out);
	if (isfinite(value))
		fprintf(out, "%.9g", value);
	fprintf(out, "\">%s</td>", text);
}

static bool picked(const struct trade *t, const struct trade_setting *s)
{
	for (uint32_t i = 0; i < t->verdicts; i++) {
		if (t->verdict[i].pick == s && t->verdict[i].outcome != TRADE_NOTHING)
			return true;
	}
	return false;
}

static void put_row(struct trade *t, const struct trade_setting *s, FILE *out)
{
	char text[40], high[96];

	fprintf(out, "<tr class=\"%s%s\">", s->front ? "front" : "", picked(t, s) ? " pick" : "");
	put_cell(out, s->front ? 0 : 1, s->front ? "●" : "");
	fputs("<td title=\"", out);
	trade_escape(out, trade_command(t, s));
	put_element(out, "\">", s->label, s->inexact ? " <span class=\"soft\">inexact</span></td>" : "</td>");
	for (int v = 0; v < TRADE_VALUES; v++) {
		const struct trade_range *r = &s->range[v];

		if (!trade_shown(t, (enum trade_value)v, true))
			continue;
		trade_value_text((enum trade_value)v, r->median, text, sizeof(text));
		put_cell(out, r->median, text);
		if (v != (int)t->clock)
			continue;
		trade_value_text((enum trade_value)v, r->high, high, sizeof(high));
		trade_value_text((enum trade_value)v, r->low, text, sizeof(text));
		fprintf(out, "<td data-v=\"%.9g\">%s–%s</td>", r->high - r->low, text, high);
	}
	fprintf(out, "<td data-v=\"%u\">%u</td></tr>\n", s->runs, s->runs);
}

static void put_table(struct trade *t, FILE *out)
{
	const struct trade_setting *order[TRADE_SETTINGS];
	uint32_t n = trade_order(t, order);

	fputs("<h2>All settings</h2>\n<p class=\"soft\">A click on a column's head sorts by it; over a setting stands "
	      "its command line. Rows with a tint are recommended.</p>\n<div class=\"wide\">\n", out);
	put_head(t, out);
	for (uint32_t i = 0; i < n; i++)
		put_row(t, order[i], out);
	fputs("</tbody></table></div>\n", out);
	for (uint32_t i = 0; i < t->settings; i++) {
		const struct trade_setting *s = &t->setting[i];

		if (s->runs && !s->failure)
			continue;
		put_element(out, s->runs ? "<p>Not repeated: <code>" : "<p>Not measured: <code>", s->label,
			    "</code>: ");
		put_element(out, "", s->failure ? s->failure : "no time left", "</p>\n");
	}
}

bool trade_html(struct trade *t, FILE *out)
{
	const char *note;

	fputs("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
	      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>", out);
	trade_escape(out, t->scene);
	fprintf(out, ": time and error</title>\n<style>\n%s</style></head>\n<body>\n", style);
	put_element(out, "<h1>", t->scene, ": what each setting costs and gains</h1>\n");
	fprintf(out, "<p class=\"soft\">alidade %s, %u × %u pixels, %u settings</p>\n", PACKAGE_VERSION,
		t->about.width, t->about.height, t->settings);
	put_verdicts(t, out);
	fputs("<h2>Error over time</h2>\n", out);
	trade_chart(t, out);
	for (uint32_t i = 0; (note = trade_note(t, i)); i++) {
		if (*note)
			put_element(out, "<p class=\"soft\">", note, "</p>\n");
	}
	put_table(t, out);
	fprintf(out, "<script>%s</script>\n</body></html>\n", script);
	return !fflush(out) && !ferror(out);
}
