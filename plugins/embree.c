/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * embree: the trees of Embree 3 (Wald et al.: Embree: A Kernel Framework for Efficient CPU Ray Tracing, 2014), for a
 * second opinion and to race against. By default it decides only which primitives are asked, and answers are those of
 * all other accelerators, to the bit. With native=1 its own triangles, in floats, have the last word.
 */
#include "embree.h"

#include <fenv.h>
#include <stdio.h>
#include <string.h>

static const char *const packet_label[] = { "auto", "1", "4", "8", "16", "stream", NULL };
static const char *const quality_label[] = { "low", "medium", "high", NULL };
static const char *const isa_label[] = { "auto", "sse4.2", "avx", "avx2", "avx512", NULL };
static const ald_param params[] = {
	{ "native", "Embree's own triangles, in floats", ALD_BOOL, 0, 0, 1, NULL },
	{ "packet", "rays of a call; auto: 4 from one origin, else 1; native=1: 16 if they are coherent, else 8",
	  ALD_CHOICE, PACKET_AUTO, 0, 5, packet_label },
	{ "robust", "with native=1: Embree's watertight mode", ALD_BOOL, 1, 0, 1, NULL },
	{ "quality", "of the tree: Morton order, surface areas, or spatial splits too", ALD_CHOICE, 1, 0, 2,
	  quality_label },
	{ "isa", "instruction set; auto: Embree's choice", ALD_CHOICE, 0, 0, 4, isa_label },
	{ "hugepages", "ask for large pages of memory", ALD_BOOL, 0, 0, 1, NULL },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

static const char purpose[] = "embree: tree";

/* ---- what Embree calls while it builds, from any thread ---- */

static _Thread_local char self;

static bool on_memory(void *ptr, ssize_t bytes, bool post)
{
	ald_accel *a = ptr;
	const ald_host *h = a->host;
	int64_t now, peak = atomic_load(&a->peak);

	(void)post;
	if (h->size > offsetof(ald_host, account) && h->account && !h->account(h->ctx, bytes, purpose)) {
		atomic_store(&a->stop, ALD_NO_MEMORY);
		return false;
	}
	now = atomic_fetch_add(&a->bytes, bytes) + bytes;
	while (now > peak && !atomic_compare_exchange_weak(&a->peak, &peak, now))
		;
	return true;
}

static bool on_progress(void *ptr, double done)
{
	ald_accel *a = ptr;

	/* The host is to be asked by one thread, its own. */
	if (a->self == &self && a->host->progress(a->host->ctx, 0.2 + 0.75 * ald_min(done, 1)))
		atomic_store(&a->stop, ALD_CANCELLED);
	return !atomic_load(&a->stop);
}

static void on_error(void *ptr, enum RTCError code, const char *text)
{
	ald_accel *a = ptr;

	if (code == RTC_ERROR_OUT_OF_MEMORY && !atomic_load(&a->stop))
		atomic_store(&a->stop, ALD_NO_MEMORY);
	snprintf(a->why, sizeof(a->why), "%s", text ? text : "no reason given");
}

static void on_bounds(const struct RTCBoundsFunctionArguments *args)
{
	const ald_accel *a = args->geometryUserPtr;

	memcpy(&args->bounds_o->lower_x, &a->bounds[args->primID][0], 3 * sizeof(float));
	memcpy(&args->bounds_o->upper_x, &a->bounds[args->primID][3], 3 * sizeof(float));
}

/* ---- building ---- */

enum { SLICE = 4096 };
struct measure {
	ald_accel *a;
	ald_box *box; /* of each slice */
	float *vertex; /* of native=1 */
	uint32_t vertices;
};

static void measure_slice(void *arg, uint32_t i)
{
	struct measure *m = arg;
	const ald_prims *p = m->a->prims;
	ald_box box;

	m->box[i] = ald_box_empty();
	for (uint32_t id = i * SLICE; id < p->count && id / SLICE == i; id++) {
		p->bounds(p, id, &box);
		ald_box_join(&m->box[i], &box);
	}
}

/* Floats are rounded outward, which by 2^-20 is done with what boxes grow by. */
static void bounds_slice(void *arg, uint32_t i)
{
	struct measure *m = arg;
	ald_accel *a = m->a;
	const ald_prims *p = a->prims;
	uint32_t n = p->count - a->first;
	double grow = GROWN + 4 * p->pad * a->scale;
	ald_box box;

	for (uint32_t k = i * SLICE; k < n && k / SLICE == i; k++) {
		p->bounds(p, a->first + k, &box);
		for (unsigned j = 0; j < 3; j++) {
			a->bounds[k][j] = ald_float_down(((&box.lo.x)[j] - a->centre[j]) * a->scale - grow);
			a->bounds[k][3 + j] = ald_float_up(((&box.hi.x)[j] - a->centre[j]) * a->scale + grow);
		}
	}
}

static void run(const ald_accel *a, uint32_t n, void (*job)(void *, uint32_t), struct measure *m)
{
	a->host->parallel(a->host->ctx, (n + SLICE - 1) / SLICE, job, m);
}

static int measure(ald_accel *a)
{
	const ald_host *h = a->host;
	uint32_t slices = (a->prims->count + SLICE - 1) / SLICE;
	struct measure m = { .a = a };
	double size = 0;

	m.box = h->alloc(h->ctx, (slices + (size_t)1) * sizeof(*m.box), purpose);
	if (!m.box)
		return ALD_NO_MEMORY;
	run(a, a->prims->count, measure_slice, &m);
	a->box = ald_box_empty();
	for (uint32_t i = 0; i < slices; i++)
		ald_box_join(&a->box, &m.box[i]);
	h->free(h->ctx, m.box);
	a->frame = ald_frame_for(a->prims, &a->box);
	for (unsigned k = 0; k < 3; k++) {
		a->centre[k] = ald_get(&a->frame.centre, k);
		size = ald_max((&a->box.hi.x)[k] - a->centre[k], ald_max(a->centre[k] - (&a->box.lo.x)[k], size));
	}
	a->scale = ldexp(1, -ilogb(ald_max(size, 0x1p-1000)) - 1);
	return ALD_OK;
}

static void place_vertex(const ald_accel *a, const ald_vec *v, float *out)
{
	for (unsigned j = 0; j < 3; j++)
		out[j] = (float)((ald_get(v, j) - a->centre[j]) * a->scale);
}

/* Where groups have origins, a vertex that they share is in several places: each triangle has its own then. */
static void fill_triangles(const ald_accel *a, uint32_t *index, float *vertex)
{
	const ald_prims *p = a->prims;
	ald_vec v[3];

	for (uint32_t id = 0; id < p->tri_count; id++) {
		ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
		for (unsigned k = 0; k < 3; k++) {
			size_t at = 3 * (size_t)id + k;

			index[at] = p->origin ? (uint32_t)at : p->index[at];
			place_vertex(a, &v[k], vertex + 3 * (size_t)index[at]);
		}
	}
}

static int add_triangles(ald_accel *a)
{
	const ald_prims *p = a->prims;
	RTCGeometry g = rtcNewGeometry(a->device, RTC_GEOMETRY_TYPE_TRIANGLE);
	size_t corners = 3 * (size_t)p->tri_count, vertices = 0;
	uint32_t *index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, p->tri_count);
	float *vertex;

	for (size_t i = 0; i < corners && !p->origin; i++)
		vertices = p->index[i] >= vertices ? p->index[i] + (size_t)1 : vertices;
	if (p->origin)
		vertices = corners;
	vertex = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertices);
	if (!index || !vertex) {
		rtcReleaseGeometry(g);
		return ALD_NO_MEMORY;
	}
	memset(vertex, 0, vertices * 12);
	fill_triangles(a, index, vertex);
	rtcCommitGeometry(g);
	rtcAttachGeometryByID(a->scene, g, TRIANGLES);
	rtcReleaseGeometry(g);
	return ALD_OK;
}

static int add_others(ald_accel *a)
{
	uint32_t n = a->prims->count - a->first;
	struct measure m = { .a = a };
	RTCGeometry g;

	if (!n)
		return ALD_OK;
	a->bounds = a->host->alloc(a->host->ctx, n * sizeof(*a->bounds), purpose);
	if (!a->bounds)
		return ALD_NO_MEMORY;
	run(a, n, bounds_slice, &m);
	g = rtcNewGeometry(a->device, RTC_GEOMETRY_TYPE_USER);
	rtcSetGeometryUserPrimitiveCount(g, n);
	rtcSetGeometryUserData(g, a);
	rtcSetGeometryBoundsFunction(g, on_bounds, NULL);
	rtcSetGeometryIntersectFunction(g, embree_intersect_cb);
	rtcSetGeometryOccludedFunction(g, embree_occluded_cb);
	rtcCommitGeometry(g);
	rtcAttachGeometryByID(a->scene, g, OTHERS);
	rtcReleaseGeometry(g);
	return ALD_OK;
}

static int open_device(ald_accel *a, const double *value, ald_error *err)
{
	unsigned isa = (unsigned)value[P_ISA];
	char config[128];

	snprintf(config, sizeof(config), "threads=%u,set_affinity=0,hugepages=%d%s%s", a->host->threads,
		 value[P_HUGE] > 0, isa ? ",isa=" : "", isa ? isa_label[isa] : "");
	a->device = rtcNewDevice(config);
	if (a->device && !rtcGetDeviceError(a->device))
		return ALD_OK;
	snprintf(err->text, sizeof(err->text), "isa=%s: Embree does not offer it on this processor; give isa=auto",
		 isa_label[isa]);
	return ALD_BAD_PARAM;
}

static int make_tree(ald_accel *a, const double *value, ald_error *err)
{
	static const enum RTCBuildQuality quality[] = { RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM,
							RTC_BUILD_QUALITY_HIGH };
	int status = open_device(a, value, err), watertight = !a->native || value[P_ROBUST] > 0;

	if (status)
		return status;
	rtcSetDeviceErrorFunction(a->device, on_error, a);
	rtcSetDeviceMemoryMonitorFunction(a->device, on_memory, a);
	a->scene = rtcNewScene(a->device);
	rtcSetSceneFlags(a->scene, (watertight ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
					   (a->native ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : 0));
	rtcSetSceneBuildQuality(a->scene, quality[(unsigned)value[P_QUALITY]]);
	rtcSetSceneProgressMonitorFunction(a->scene, on_progress, a);
	if (a->native && a->prims->tri_count)
		status = add_triangles(a);
	if (!status)
		status = add_others(a);
	if (!status)
		rtcCommitScene(a->scene);
	rtcSetSceneProgressMonitorFunction(a->scene, NULL, NULL);
	a->host->free(a->host->ctx, a->bounds);
	a->bounds = NULL;
	if (atomic_load(&a->stop))
		return atomic_load(&a->stop);
	if (!status && (a->why[0] || rtcGetDeviceError(a->device))) {
		snprintf(err->text, sizeof(err->text), "Embree says: %s", a->why);
		return ALD_FAILED;
	}
	return status;
}

static void embree_destroy(ald_accel *a)
{
	const ald_host *h = a->host;
	fenv_t modes;

	fegetenv(&modes);
	if (a->scene)
		rtcReleaseScene(a->scene);
	if (a->device)
		rtcReleaseDevice(a->device);
	fesetenv(&modes);
	h->free(h->ctx, a);
}

static int embree_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
			ald_error *err)
{
	ald_accel *a;
	fenv_t modes;
	int status;

	if (value[P_NATIVE] > 0 && prims->precision == ALD_PRECISION_EXACT) {
		snprintf(err->text, sizeof(err->text),
			 "native=1 is inexact, and --precision=exact is asked for; leave one out");
		return ALD_BAD_PARAM;
	}
	a = host->alloc(host->ctx, sizeof(*a), purpose);
	if (!a)
		return ALD_NO_MEMORY;
	memset(a, 0, sizeof(*a));
	a->host = host;
	a->prims = prims;
	a->self = &self;
	a->native = value[P_NATIVE] > 0;
	a->first = a->native ? prims->tri_count : 0;
	a->packet = (unsigned)value[P_PACKET];
	fegetenv(&modes);
	status = host->progress(host->ctx, 0) ? ALD_CANCELLED : ALD_OK;
	if (!status && prims->count)
		status = measure(a);
	if (!status && prims->count)
		status = make_tree(a, value, err);
	fesetenv(&modes); /* R5: Embree would have small numbers be 0 */
	if (status)
		embree_destroy(a);
	else
		*out = a;
	return status;
}

/* Embree's own memory, measured for torus, statue, terrain and loose triangles, a primitive: within a tenth of these.
 * What native=1 takes, with shared corners and splits, differs too much. */
static int embree_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	static const double kept[] = { 30.5, 91, 91 }, peak[] = { 92, 150, 150 };
	unsigned quality = (unsigned)value[P_QUALITY];

	(void)host;
	if (value[P_NATIVE] > 0)
		return ALD_UNSUPPORTED;
	out->kept = sizeof(ald_accel) + (uint64_t)(kept[quality] * prims->count);
	out->peak = sizeof(ald_accel) + (uint64_t)(peak[quality] * prims->count);
	out->scratch = 0;
	return ALD_OK;
}

/* ---- rays ---- */

static unsigned packet_for(const ald_accel *a, uint32_t n, uint32_t hints)
{
	if (a->packet != PACKET_AUTO)
		return a->packet;
	if (n < 4)
		return PACKET_1;
	if (a->native)
		return hints & ALD_COHERENT ? PACKET_16 : PACKET_8;
	return hints & ALD_ONE_ORIGIN ? PACKET_4 : PACKET_1;
}

static void call_begin(struct call *c, const ald_accel *a, ald_query *q, struct beam *beam, uint32_t hints, int any)
{
	rtcInitIntersectContext(&c->context);
	c->context.flags = hints & ALD_COHERENT ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT :
						  RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
	c->a = a;
	c->q = q;
	c->beam = beam;
	c->any = any;
}

static void embree_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
			       uint32_t hints)
{
	struct beam beam[STREAM];
	struct call c;

	if (!a->scene)
		return;
	call_begin(&c, a, q, beam, hints, 0);
	for (uint32_t at = 0; at < n; at += STREAM)
		embree_fire(&c, ray + at, hit + at, n - at < STREAM ? n - at : STREAM, packet_for(a, n, hints));
}

static void embree_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
			      uint32_t hints)
{
	struct beam beam[STREAM];
	ald_hit hit[STREAM];
	struct call c;

	memset(hidden, 0, n);
	if (!a->scene)
		return;
	call_begin(&c, a, q, beam, hints, 1);
	for (uint32_t at = 0; at < n; at += STREAM) {
		uint32_t m = n - at < STREAM ? n - at : STREAM;

		for (uint32_t i = 0; i < m; i++)
			hit[i] = (ald_hit){ .t = ray[at + i].tmax, .prim = ALD_NONE, .part = ALD_NONE };
		embree_fire(&c, ray + at, hit, m, packet_for(a, n, hints));
		for (uint32_t i = 0; i < m; i++)
			hidden[at + i] = !!beam[i].found;
	}
}

static int embree_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	struct beam beam;
	struct call c;

	if (!a->scene)
		return 0;
	call_begin(&c, a, q, &beam, 0, 0);
	embree_fire(&c, ray, hit, 1, PACKET_1);
	return beam.found;
}

static int embree_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	embree_occluded_n(a, q, ray, &hidden, 1, 0);
	return hidden;
}

static int embree_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	if (i > 1)
		return 0;
	*name = i ? "memory" : "memory while building";
	*value = (double)(i ? atomic_load(&a->bytes) : atomic_load(&a->peak)) + sizeof(*a);
	return 1;
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "embree",
	.version = RTC_VERSION_STRING,
	.license = "Apache-2.0",
	.summary = "Embree's trees of boxes",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT,
	.build = embree_build,
	.intersect = embree_intersect,
	.destroy = embree_destroy,
	.occluded = embree_occluded,
	.intersect_n = embree_intersect_n,
	.occluded_n = embree_occluded_n,
	.stat = embree_stat,
	.inexact = 1u << P_NATIVE,
	.predict = embree_predict,
};
