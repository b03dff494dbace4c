/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Fractals in the plane of x and y (manual 3.4.7.1.11): Mandelbrot and Julia sets of z^n + c, and the two
 * magnet models (Peitgen and Richter, The Beauty of Fractals, 1986, section 10).
 */
#include "pattern/family.h"

struct complex {
	double re, im;
};

static struct complex times(struct complex a, struct complex b)
{
	return (struct complex){ a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re };
}

static double norm(struct complex a)
{
	return a.re * a.re + a.im * a.im;
}

static struct complex over(struct complex a, struct complex b)
{
	double n = norm(b);

	return (struct complex){ (a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n };
}

static struct complex power_step(struct complex z, struct complex c, uint32_t exponent)
{
	struct complex w = times(z, z);

	for (uint32_t i = 2; i < exponent; i++)
		w = times(w, z);
	return (struct complex){ w.re + c.re, w.im + c.im };
}

/* ((z^2 + c - 1) / (2 z + c - 2))^2 */
static struct complex magnet1_step(struct complex z, struct complex c)
{
	struct complex z2 = times(z, z), w;

	w = over((struct complex){ z2.re + c.re - 1, z2.im + c.im },
		 (struct complex){ 2 * z.re + c.re - 2, 2 * z.im + c.im });
	return times(w, w);
}

/* ((z^3 + 3 (c - 1) z + (c - 1) (c - 2)) / (3 z^2 + 3 (c - 2) z + (c - 1) (c - 2) + 1))^2 */
static struct complex magnet2_step(struct complex z, struct complex c)
{
	const struct complex c1 = { c.re - 1, c.im }, c2 = { c.re - 2, c.im }, both = times(c1, c2);
	struct complex z2 = times(z, z), z3 = times(z2, z), a = times(c1, z), b = times(c2, z), w;

	w = over((struct complex){ z3.re + 3 * a.re + both.re, z3.im + 3 * a.im + both.im },
		 (struct complex){ 3 * z2.re + 3 * b.re + both.re + 1, 3 * z2.im + 3 * b.im + both.im });
	return times(w, w);
}

/* A remainder of the count; POV-Ray's factors below 1 divide by nothing. */
static double wrapped(uint32_t count, double by, double factor)
{
	return by >= 1 && by < 4e9 ? count % (uint32_t)by / factor : 0;
}

static double outside(const struct pattern *q, uint32_t count, struct complex z)
{
	double factor = q->of.fractal.exterior_factor;

	switch (q->of.fractal.exterior) {
	case 0:
		return factor;
	case 1:
		return (double)count / q->of.fractal.iterations;
	case 2:
		return z.re * factor;
	case 3:
		return z.im * factor;
	case 4:
		return z.re * z.re * factor;
	case 5:
		return z.im * z.im * factor;
	case 6:
		return sqrt(norm(z)) * factor;
	case 7:
		return wrapped(count, factor, factor);
	default:
		return wrapped(count, 1 + factor, factor);
	}
}

static double inside(const struct pattern *q, struct complex z, double nearest)
{
	double factor = q->of.fractal.interior_factor;

	switch (q->of.fractal.interior) {
	case 0:
		return factor;
	case 1:
		return sqrt(nearest) * factor;
	case 2:
		return z.re * factor;
	case 3:
		return z.im * factor;
	case 4:
		return z.re * z.re * factor;
	case 5:
		return z.im * z.im * factor;
	default: /* the factor belongs to the second square alone: measured */
		return z.re * z.re + z.im * z.im * factor;
	}
}

static bool escaped(uint32_t magnet, struct complex z, double n)
{
	const struct complex from_one = { z.re - 1, z.im };

	return magnet ? n > 10000 || norm(from_one) < 1 / 10000.0 : n > 4;
}

double fractal_value(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	const struct complex p = { at->p.x, at->p.y }, given = { q->of.fractal.re, q->of.fractal.im };
	const struct complex c = q->of.fractal.julia ? given : p;
	uint32_t magnet = q->of.fractal.magnet;
	struct complex z = p;
	double nearest = magnet ? 10000 : norm(p);

	(void)s;
	if (magnet && !q->of.fractal.julia)
		z.re = z.im = 0;
	for (uint32_t i = 0; i < q->of.fractal.iterations; i++) {
		double n;

		z = magnet == 1 ? magnet1_step(z, c) :
		    magnet == 2 ? magnet2_step(z, c) :
				  power_step(z, c, q->of.fractal.exponent);
		n = norm(z);
		if (n < nearest)
			nearest = n;
		if (escaped(magnet, z, n))
			return outside(q, i, z);
	}
	return inside(q, z, nearest);
}
