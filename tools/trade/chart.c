/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Error over time as SVG, both axes logarithmic. Errors of 0, which have no logarithm, stand in a band of
 * their own below. Colours are those of the page's style sheet, so that it can be read by day and by night.
 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "trade.h"

#define WIDTH 920.0
#define HEIGHT 560.0
#define LEFT 76.0
#define RIGHT 22.0
#define TOP 30.0
#define BOTTOM 54.0
#define BAND 30.0 /* height of the band of zeros */
#define LETTER 6.3 /* width of one at 11 pixels, a little more than usual */
#define LINE 13.0
#define LABEL_LONGEST 64
#define RINGS 6
#define RINGS_BEATEN 2 /* who is not on the front gets a label only where there is room */
#define BOXES 512

struct axis {
	double low, high; /* logarithms */
	double from, to; /* pixels */
	bool zeros;
};

struct box {
	double x0, y0, x1, y1;
};

struct chart {
	struct trade *t;
	FILE *out;
	struct axis x, y;
	struct box box[BOXES]; /* where something stands already */
	uint32_t boxes;
};

static double place(const struct axis *a, double value)
{
	double w;

	if (!(value > 0))
		return a->from + (a->zeros ? BAND / 2 : 0);
	w = (log10(value) - a->low) / (a->high - a->low);
	w = w < 0 ? 0 : w > 1 ? 1 : w;
	return a->from + w * (a->to - a->from);
}

/* Around all medians and intervals, with some air. */
static void fit(struct axis *a, const struct trade *t, const struct trade_setting **s, uint32_t n,
		enum trade_value v)
{
	double low = HUGE_VAL, high = 0, air;

	for (uint32_t i = 0; i < n; i++) {
		const struct trade_range *r = &s[i]->range[v];
		double x[] = { fabs(r->median), fabs(r->low), fabs(r->high) };

		for (int k = 0; k < 3; k++) {
			a->zeros = a->zeros || (!k && !(x[k] > 0));
			low = x[k] > 0 && x[k] < low ? x[k] : low;
			high = x[k] > high ? x[k] : high;
		}
	}
	(void)t;
	if (!(high > 0))
		low = high = 1;
	a->low = log10(low);
	a->high = log10(high);
	air = fmax(0.06 * (a->high - a->low), 0.04);
	a->low -= air;
	a->high += air;
}

/* 1, 2, 5, 10, ..; every decade alone where there are many. */
static void put_ticks(const struct chart *c, const struct axis *a, bool upright)
{
	static const int all[] = { 1, 2, 5 };
	bool narrow = a->high - a->low < 0.35;
	double from = upright ? LEFT : TOP;

	for (int e = (int)floor(a->low); e <= (int)ceil(a->high); e++) {
		for (int k = 1; k < 10; k++) {
			double value = k * pow(10, e), at = place(a, value);
			bool named = narrow || a->high - a->low < 0.8 || (k == all[0]) ||
				     ((k == all[1] || k == all[2]) && a->high - a->low < 2.5);

			if (log10(value) < a->low || log10(value) > a->high)
				continue;
			if (upright)
				fprintf(c->out, "<path class=\"%s\" d=\"M%.1f %.1fH%.1f\"/>", named ? "grid" : "fine",
					from, at, WIDTH - RIGHT);
			else
				fprintf(c->out, "<path class=\"%s\" d=\"M%.1f %.1fV%.1f\"/>", named ? "grid" : "fine",
					at, from, HEIGHT - BOTTOM);
			if (named && upright)
				fprintf(c->out, "<text class=\"tick\" x=\"%.1f\" y=\"%.1f\" "
						"text-anchor=\"end\">%g</text>\n",
					LEFT - 8, at + 4, value);
			else if (named)
				fprintf(c->out, "<text class=\"tick\" x=\"%.1f\" y=\"%.1f\" "
						"text-anchor=\"middle\">%g</text>\n",
					at, HEIGHT - BOTTOM + 17, value);
		}
	}
}

static void put_axes(const struct chart *c)
{
	const struct trade_column *x = &trade_column[c->t->clock], *y = &trade_column[c->t->error];

	put_ticks(c, &c->x, false);
	put_ticks(c, &c->y, true);
	if (c->y.zeros)
		fprintf(c->out, "<rect class=\"band\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>"
				"<text class=\"tick\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">0</text>\n",
			LEFT, HEIGHT - BOTTOM - BAND, WIDTH - LEFT - RIGHT, BAND, LEFT - 8,
			HEIGHT - BOTTOM - BAND / 2 + 4);
	fprintf(c->out, "<rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", LEFT, TOP,
		WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
	fprintf(c->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s of the %s, s (less is faster)</text>\n",
		(LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, c->t->clock == TRADE_CPU ? "CPU time" : "time",
		c->t->clock == TRADE_RENDER ? "drawing" : "process");
	(void)x;
	fprintf(c->out, "<text transform=\"rotate(-90 16 %.1f)\" x=\"16\" y=\"%.1f\" text-anchor=\"middle\">%s, %s"
			" (less is better)</text>\n",
		HEIGHT / 2, HEIGHT / 2, y->title, c->t->space == DIFF_LINEAR ? "linear light" : "of the sRGB scale");
}

/* A setting that differs from the default in one factor has that factor's colour. */
static int colour_of(const struct trade *t, const struct trade_setting *s)
{
	int colour = -1;

	for (uint32_t f = 0; f < t->factors; f++) {
		if (s->level[f])
			colour = colour < 0 ? (int)(f % 6) : 6;
	}
	return colour < 0 ? 7 : colour;
}

static void put_front(const struct chart *c, const struct trade_setting **s, uint32_t n)
{
	bool first = true;

	fputs("<path class=\"front\" d=\"", c->out);
	for (uint32_t i = 0; i < n; i++) {
		double x = place(&c->x, s[i]->range[c->t->clock].median);
		double y = place(&c->y, fabs(s[i]->range[c->t->error].median));

		if (!s[i]->front)
			continue;
		fprintf(c->out, first ? "M%.1f %.1f" : "H%.1fV%.1f", x, y);
		first = false;
	}
	fputs("\"/>\n", c->out);
}

static void claim(struct chart *c, double x0, double y0, double x1, double y1)
{
	if (c->boxes < BOXES)
		c->box[c->boxes++] = (struct box){ x0, y0, x1, y1 };
}

static void put_point(struct chart *c, const struct trade_setting *s)
{
	const struct trade_range *tr = &s->range[c->t->clock], *er = &s->range[c->t->error];
	double x = place(&c->x, tr->median), y = place(&c->y, fabs(er->median));
	char time[40], error[40];

	trade_value_text(c->t->clock, tr->median, time, sizeof(time));
	trade_value_text(c->t->error, er->median, error, sizeof(error));
	fprintf(c->out, "<g class=\"k%d%s\">", colour_of(c->t, s), s->front ? " on" : "");
	fprintf(c->out, "<path class=\"bar\" d=\"M%.1f %.1fH%.1fM%.1f %.1fV%.1f\"/>", place(&c->x, tr->low), y,
		place(&c->x, tr->high), x, place(&c->y, fabs(er->low)), place(&c->y, fabs(er->high)));
	fprintf(c->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"><title>", x, y, s->front ? "5.5" : "4");
	trade_escape(c->out, s->label);
	fprintf(c->out, ": %s s, %s %s</title></circle></g>\n", time, trade_column[c->t->error].title, error);
	claim(c, x - 6, y - 6, x + 6, y + 6);
}

static double overlap(const struct chart *c, const struct box *b)
{
	double sum = 0;

	for (uint32_t i = 0; i < c->boxes; i++) {
		const struct box *o = &c->box[i];
		double w = fmin(b->x1, o->x1) - fmax(b->x0, o->x0), h = fmin(b->y1, o->y1) - fmax(b->y0, o->y0);

		sum += w > 0 && h > 0 ? w * h : 0;
	}
	if (b->x0 < LEFT + 2 || b->x1 > WIDTH - RIGHT - 2 || b->y0 < TOP + 2 || b->y1 > HEIGHT - BOTTOM - 2)
		sum += 1e6;
	return sum;
}

/* Rings of places around the point: the first that is free, with a line to it if it is far. */
static void put_label(struct chart *c, const struct trade_setting *s)
{
	static const double ring[RINGS] = { 9, 22, 38, 58, 84, 116 };
	int rings = s->front || s->stage == TRADE_BASE ? RINGS : RINGS_BEATEN;
	double x = place(&c->x, s->range[c->t->clock].median);
	double y = place(&c->y, fabs(s->range[c->t->error].median)), width, best = HUGE_VAL;
	struct box found = { 0 };
	char text[LABEL_LONGEST + 8];
	bool far = false;

	snprintf(text, sizeof(text), "%.*s%s", LABEL_LONGEST, s->label,
		 strlen(s->label) > LABEL_LONGEST ? "…" : "");
	width = LETTER * fmin((double)strlen(s->label), LABEL_LONGEST + 1);
	for (int r = 0; r < rings && best > 0; r++) {
		for (int k = 0; k < 12 && best > 0; k++) {
			double a = (k % 2 ? -1 : 1) * (k / 2 * 2 + 1) * 0.2618, dx = cos(a), dy = sin(a);
			double cx = x + ring[r] * dx, cy = y - ring[r] * dy;
			double left = dx > 0.3 ? cx : dx < -0.3 ? cx - width : cx - width / 2;
			struct box b = { left, cy - LINE / 2, left + width, cy + LINE / 2 };
			double cost = overlap(c, &b);

			if (cost < best) {
				best = cost;
				found = b;
				far = r > 0;
			}
		}
	}
	if (best > (s->front ? 400 : 0)) /* unreadable; the point's title tells */
		return;
	if (far)
		fprintf(c->out, "<path class=\"lead\" d=\"M%.1f %.1fL%.1f %.1f\"/>", x, y,
			fmin(fmax(x, found.x0), found.x1), (found.y0 + found.y1) / 2);
	fprintf(c->out, "<text class=\"label\" x=\"%.1f\" y=\"%.1f\">", found.x0, found.y1 - 3);
	trade_escape(c->out, text);
	fputs("</text>\n", c->out);
	claim(c, found.x0, found.y0, found.x1, found.y1);
}

static void put_legend(const struct chart *c, const struct trade_setting **s, uint32_t n)
{
	bool used[8] = { 0 };
	double x = LEFT;

	for (uint32_t i = 0; i < n; i++)
		used[colour_of(c->t, s[i])] = true;
	for (int k = 0; k < 8; k++) {
		const char *name = k == 7 ? "default" : k == 6 ? "combined" : c->t->factor[k].name;

		if (!used[k])
			continue;
		fprintf(c->out, "<g class=\"k%d on\"><circle cx=\"%.1f\" cy=\"14\" r=\"5\"/></g>"
				"<text x=\"%.1f\" y=\"18\">", k, x + 6, x + 16);
		trade_escape(c->out, name);
		fputs("</text>\n", c->out);
		x += 34 + LETTER * 1.15 * (double)strlen(name);
	}
	fprintf(c->out, "<text x=\"%.1f\" y=\"18\" text-anchor=\"end\">filled: nothing is both faster and as accurate"
			"</text>\n", WIDTH - RIGHT);
}

void trade_chart(struct trade *t, FILE *out)
{
	const struct trade_setting *s[TRADE_SETTINGS];
	uint32_t n = trade_order(t, s);
	struct chart c = { .t = t, .out = out };

	if (!n)
		return;
	fit(&c.x, t, s, n, t->clock);
	fit(&c.y, t, s, n, t->error);
	c.x.zeros = false;
	c.x.from = LEFT;
	c.x.to = WIDTH - RIGHT;
	c.y.from = HEIGHT - BOTTOM - (c.y.zeros ? BAND : 0);
	c.y.to = TOP;
	fprintf(out, "<svg viewBox=\"0 0 %.0f %.0f\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" "
		     "aria-label=\"Error over time of each setting\">\n", WIDTH, HEIGHT);
	put_axes(&c);
	put_legend(&c, s, n);
	put_front(&c, s, n);
	for (int front = 0; front < 2; front++) {
		for (uint32_t i = 0; i < n; i++) {
			if (s[i]->front == front)
				put_point(&c, s[i]);
		}
	}
	for (int rank = 0; rank < 3; rank++) {
		for (uint32_t i = 0; i < n; i++) {
			int mine = s[i]->stage == TRADE_BASE ? 0 : s[i]->front ? 1 : 2;

			if (mine == rank)
				put_label(&c, s[i]);
		}
	}
	fputs("</svg>\n", out);
}
