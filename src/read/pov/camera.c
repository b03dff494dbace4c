/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Cameras (manual 3.4.2), placed as POV-Ray places them: whatever the order of the text, right comes
 * first, then direction, angle, up, sky, location, look_at and the transforms; before version 3.5 each
 * word acts at once.
 */
#include <config.h>

#include "read/pov/items.h"

#define TINY 1e-10 /* cosines that POV-Ray takes for 0 */
#define PI 3.14159265358979323846
#define BLUR_SAMPLES_MAX 1e6

/* A camera before it is placed. */
struct draft {
	enum camera_kind kind;
	vec location, direction, right, up, sky, look_at;
	bool has_right, has_up, has_angle, has_look_at;
	double angle, angle_up; /* degrees; 0: given without a value */
	double aperture, blur_samples, focal_distance;
	double direction_length; /* what angle or look_at left of it, for want of a focal_point */
	vec focal_point;
	bool has_focal_point;
	struct pov_normal normal;
	bool moved; /* a declared camera, complete but for transforms */
	struct xform place;
	struct diag_pos pos, angle_pos, look_pos;
	struct pov_lack lack;
};

static struct draft draft_default(void)
{
	return (struct draft){ .kind = CAMERA_PERSPECTIVE,
			       .direction = { 0, 0, 1 },
			       .right = { 1.33, 0, 0 },
			       .up = { 0, 1, 0 },
			       .sky = { 0, 1, 0 },
			       .look_at = { 0, 0, 1 },
			       .focal_distance = -1,
			       .direction_length = 1,
			       .place = xform_identity };
}

/* Only these two have the view's width in the direction's length; the others have the angle itself, or
 * none. */
static void apply_angle(struct pov *p, struct draft *d)
{
	if (d->kind != CAMERA_PERSPECTIVE && d->kind != CAMERA_ORTHOGRAPHIC)
		return;
	if (d->angle >= 180) {
		pov_fail_at(p, &d->angle_pos, "angle is %g, but has to be below 180 degrees", d->angle);
		return;
	}
	if (d->angle > 0) {
		d->direction_length = vec_length(d->right) / tan(d->angle * PI / 360) / 2;
		d->direction = vec_scale(vec_unit(d->direction), d->direction_length);
	}
}

static void apply_look_at(struct pov *p, struct draft *d)
{
	double direction = vec_length(d->direction), right = vec_length(d->right);
	double up = vec_length(d->up);
	double handed = vec_dot(vec_cross(d->up, d->direction), d->right);
	vec to = vec_sub(d->look_at, d->location), across;
	double least = TINY * vec_length(d->sky);

	if (!(vec_length(to) > 0)) {
		pov_fail_at(p, &d->look_pos, "look_at is the camera's location; move one of them");
		return;
	}
	to = vec_unit(to);
	across = vec_cross(d->sky, to);
	if (!(fabs(across.x) > least || fabs(across.y) > least || fabs(across.z) > least)) {
		pov_warn(p, &d->look_pos, "the camera looks along its sky vector: right stays as given");
		across = d->right;
	}
	across = vec_unit(across);
	d->up = vec_scale(vec_cross(to, across), up);
	d->right = vec_scale(across, handed > 0 ? right : -right);
	d->direction = vec_scale(to, direction);
	d->direction_length = direction;
}

/* The view of an orthographic camera is as wide as a perspective one's where it looks at. */
static void apply_orthographic(struct draft *d)
{
	double far = vec_length(vec_sub(d->look_at, d->location)), near = vec_length(d->direction);

	if (far > 0 && near > 0) {
		d->right = vec_scale(d->right, far / near);
		d->up = vec_scale(d->up, far / near);
	}
}

static void apply_place(struct draft *d)
{
	d->location = mat_point(&d->place.fwd, d->location);
	d->direction = mat_dir(&d->place.fwd, d->direction);
	d->right = mat_dir(&d->place.fwd, d->right);
	d->up = mat_dir(&d->place.fwd, d->up);
	d->sky = mat_dir(&d->place.fwd, d->sky);
}

static void read_cylinder(struct pov *p, struct draft *d)
{
	struct diag_pos at;
	double x;

	pov_next(p);
	at = pov_here(p);
	x = pov_finite_float(p, "the cylinder camera's type");
	if (x < 1 || x >= 5)
		pov_fail_at(p, &at, "cylinder cameras are of type 1 to 4, not %g", x);
	else
		d->kind = CAMERA_CYLINDER_1 + (unsigned)x - 1;
}

static void read_mesh_camera(struct pov *p, struct draft *d)
{
	pov_lack_note(p, &d->lack, "mesh_camera", "use another camera");
	pov_next(p);
	if (pov_token(p) == TOK_LEFT_BRACE)
		pov_skip_block(p);
}

static bool read_type(struct pov *p, struct draft *d)
{
	static const struct {
		enum pov_token_kind token;
		enum camera_kind kind;
	} type[] = { { TOK_PERSPECTIVE, CAMERA_PERSPECTIVE },
		     { TOK_ORTHOGRAPHIC, CAMERA_ORTHOGRAPHIC },
		     { TOK_FISHEYE, CAMERA_FISHEYE },
		     { TOK_ULTRA_WIDE_ANGLE, CAMERA_ULTRA_WIDE_ANGLE },
		     { TOK_OMNIMAX, CAMERA_OMNIMAX },
		     { TOK_PANORAMIC, CAMERA_PANORAMIC },
		     { TOK_SPHERICAL, CAMERA_SPHERICAL } };
	enum pov_token_kind t = pov_token(p);

	if (t == TOK_CYLINDER) {
		read_cylinder(p, d);
		return true;
	}
	if (t == TOK_MESH_CAMERA) {
		read_mesh_camera(p, d);
		return true;
	}
	for (size_t i = 0; i < sizeof(type) / sizeof(type[0]); i++) {
		if (t != type[i].token)
			continue;
		pov_next(p);
		d->kind = type[i].kind;
		if (t == TOK_ORTHOGRAPHIC && pov_version(p) < 350)
			apply_orthographic(d);
		return true;
	}
	return false;
}

static void read_angle(struct pov *p, struct draft *d)
{
	pov_next(p);
	d->angle_pos = pov_here(p);
	d->has_angle = true;
	d->angle = 0;
	/* The add-on writes the word alone in orthographic cameras. */
	if (pov_starts_number(p))
		d->angle = pov_finite_float(p, "angle");
	else if (d->kind != CAMERA_ORTHOGRAPHIC)
		pov_fail(p, "angle needs a number of degrees");
	if (d->kind == CAMERA_SPHERICAL) {
		d->angle_up = d->angle / 2;
		pov_comma(p);
		if (pov_starts_number(p))
			d->angle_up = pov_finite_float(p, "angle");
	}
	if (d->angle < 0 || d->angle_up < 0)
		pov_fail_at(p, &d->angle_pos, "angle is %g, but cannot be negative",
			    d->angle < 0 ? d->angle : d->angle_up);
	if (pov_version(p) < 350 && d->kind == CAMERA_PERSPECTIVE)
		apply_angle(p, d);
}

static void read_look_at(struct pov *p, struct draft *d)
{
	pov_next(p);
	d->look_pos = pov_here(p);
	d->look_at = pov_finite_vector(p, "look_at");
	d->has_look_at = true;
	if (pov_version(p) < 350 && !pov_failed(p))
		apply_look_at(p, d);
}

/* blur_samples MOST or LEAST, MOST. What is least does not matter here: see render/lens.c. */
static void read_blur_samples(struct pov *p, struct draft *d)
{
	struct diag_pos at;
	double least = 0;

	pov_next(p);
	at = pov_here(p);
	d->blur_samples = pov_finite_float(p, "blur_samples");
	if (d->blur_samples <= 0)
		pov_fail_at(p, &at, "blur_samples is %g, but has to be greater than 0", d->blur_samples);
	pov_comma(p);
	if (pov_starts_number(p)) {
		least = d->blur_samples;
		d->blur_samples = pov_finite_float(p, "blur_samples");
	}
	if (d->blur_samples == 0)
		d->blur_samples = least;
	else if (least > d->blur_samples)
		pov_fail_at(p, &at, "blur_samples: the smaller number comes first");
}

/* Depth of field, and a bumpy lens, which is not rendered. */
/* Patterns that bend the camera's rays. */
static void read_normal(struct pov *p, struct draft *d)
{
	struct pov_normal *n = pov_read_normal(p, &d->normal);

	if (!n)
		return;
	d->normal = *n;
	pov_lack_add(&d->lack, &n->lack);
}

static bool read_optics(struct pov *p, struct draft *d)
{
	switch (pov_token(p)) {
	case TOK_APERTURE:
		pov_next(p);
		d->aperture = pov_finite_float(p, "aperture");
		return true;
	case TOK_BLUR_SAMPLES:
		read_blur_samples(p, d);
		return true;
	case TOK_CONFIDENCE:
	case TOK_VARIANCE:
		pov_next(p);
		pov_float(p);
		return true;
	case TOK_FOCAL_POINT:
		pov_next(p);
		d->focal_point = pov_finite_vector(p, "focal_point");
		d->has_focal_point = true;
		if (pov_version(p) < 350)
			d->focal_distance = vec_length(vec_sub(d->focal_point, d->location));
		return true;
	case TOK_NORMAL:
		read_normal(p, d);
		return true;
	case TOK_BOKEH:
		pov_lack_note(p, &d->lack, "bokeh", "remove bokeh { }, which POV-Ray 3.7 does not know");
		pov_next(p);
		pov_skip_block(p);
		return true;
	default:
		return false;
	}
}

static bool read_modifier(struct pov *p, struct draft *d)
{
	static const struct {
		enum pov_token_kind token;
		const char *name;
	} word[] = { { TOK_LOCATION, "location" }, { TOK_DIRECTION, "direction" },
		     { TOK_RIGHT, "right" },	   { TOK_UP, "up" },
		     { TOK_SKY, "sky" } };
	vec *to[] = { &d->location, &d->direction, &d->right, &d->up, &d->sky };
	enum pov_token_kind t = pov_token(p);

	for (size_t i = 0; i < sizeof(word) / sizeof(word[0]); i++) {
		if (t != word[i].token)
			continue;
		pov_next(p);
		*to[i] = pov_finite_vector(p, word[i].name);
		d->has_right |= t == TOK_RIGHT;
		d->has_up |= t == TOK_UP;
		return true;
	}
	switch (t) {
	case TOK_ANGLE:
		read_angle(p, d);
		return true;
	case TOK_LOOK_AT:
		read_look_at(p, d);
		return true;
	default:
		if (pov_transform(p, &d->place)) {
			if (pov_version(p) < 350) {
				apply_place(d);
				d->place = xform_identity;
			}
			return true;
		}
		return read_optics(p, d) || read_type(p, d);
	}
}

static bool is_skew(vec a, vec b)
{
	return fabs(vec_dot(a, b)) > TINY * vec_length(a) * vec_length(b);
}

static void check_camera(struct pov *p, const struct draft *d)
{
	vec normal = vec_cross(d->right, d->up);

	if (pov_failed(p))
		return;
	if (!vec_finite(d->location) || !vec_finite(d->direction) || !vec_finite(normal))
		pov_fail_at(p, &d->pos, "the camera's vectors are too large");
	else if (fabs(vec_dot(normal, d->direction)) == 0)
		pov_fail_at(p, &d->pos, "the camera's right, up and direction lie in one plane: nothing "
			    "could be seen");
	else if (is_skew(d->right, d->up) || is_skew(d->right, d->direction) || is_skew(d->up, d->direction))
		pov_warn(p, &d->pos, "the camera's right, up and direction are not perpendicular: the "
			 "picture will be skewed");
}

/* camera { NAME transforms }: the declared camera is moved as a whole. */
static void move_declared(struct pov *p, const struct pov_camera *c, struct draft *d)
{
	d->kind = c->camera.kind;
	d->angle = c->camera.angle;
	d->angle_up = c->camera.angle_up;
	d->aperture = c->camera.aperture;
	d->focal_distance = c->camera.focal_distance;
	d->blur_samples = c->camera.blur_samples;
	d->location = c->camera.location;
	d->direction = c->camera.direction;
	d->right = c->camera.right;
	d->up = c->camera.up;
	d->normal.normal = c->camera.normal;
	d->lack = c->lack;
	d->moved = true;
	while (!pov_failed(p) && pov_transform(p, &d->place))
		;
	apply_place(d);
}

static void read_body(struct pov *p, struct draft *d)
{
	const struct pov_camera *c = pov_take(p, ITEM_CAMERA);

	if (c) {
		move_declared(p, c, d);
		return;
	}
	while (!pov_failed(p) && read_modifier(p, d))
		;
	if (pov_version(p) < 350 || pov_failed(p))
		return;
	if (d->has_angle)
		apply_angle(p, d);
	if (d->has_look_at && !pov_failed(p))
		apply_look_at(p, d);
	/* As the add-on relies on: an angle of any value, or neither up nor right given. */
	if (d->kind == CAMERA_ORTHOGRAPHIC && (d->has_angle || (!d->has_up && !d->has_right)))
		apply_orthographic(d);
	/* The transforms do not change it, as in POV-Ray. */
	if (d->has_focal_point)
		d->focal_distance = vec_length(vec_sub(d->focal_point, d->location));
	apply_place(d);
}

/* POV-Ray's angles for want of others, and what is in focus for want of a focal_point. */
static struct camera finished(const struct draft *d)
{
	struct camera c = { .kind = d->kind,
			    .location = d->location,
			    .direction = d->direction,
			    .right = d->right,
			    .up = d->up,
			    .angle = d->angle,
			    .angle_up = d->angle_up,
			    .focal_distance = d->focal_distance,
			    .normal = d->normal.normal,
			    .pos = d->pos };

	if (!d->moved && !d->has_angle) {
		c.angle = d->kind == CAMERA_SPHERICAL ? 360 : 90;
		c.angle_up = 180;
	}
	if (c.focal_distance < 0)
		c.focal_distance = d->direction_length;
	if (c.focal_distance == 0)
		c.focal_distance = 1;
	if (d->blur_samples > 0) {
		c.aperture = d->aperture;
		c.blur_samples = (uint32_t)fmin(d->blur_samples, BLUR_SAMPLES_MAX);
	}
	return c;
}

/* Where rays start in a line or plane POV-Ray 3.7 lets its lens make one point of them. */
static void check_lens(struct pov *p, const struct camera *c)
{
	if (c->aperture != 0 && (c->kind == CAMERA_ORTHOGRAPHIC || c->kind == CAMERA_CYLINDER_3 ||
				 c->kind == CAMERA_CYLINDER_4))
		pov_warn(p, &c->pos, "focal blur of this kind of camera is drawn as it is meant; POV-Ray "
			 "3.7 draws one point of the picture everywhere");
}

struct pov_camera *pov_read_camera(struct pov *p)
{
	struct draft d = draft_default();
	struct pov_camera *c;

	d.pos = pov_here(p);
	if (!pov_open(p))
		return NULL;
	read_body(p, &d);
	if (!d.lack.construct)
		check_camera(p, &d);
	c = pov_new(p, sizeof(*c));
	if (!c || !pov_close(p, "camera"))
		return NULL;
	if (d.normal.normal && d.kind != CAMERA_PERSPECTIVE && d.kind != CAMERA_ORTHOGRAPHIC)
		pov_lack_note(p, &d.lack, "a normal in this kind of camera", "remove normal { } from the camera");
	c->camera = finished(&d);
	c->lack = d.lack;
	check_lens(p, &c->camera);
	return c;
}
