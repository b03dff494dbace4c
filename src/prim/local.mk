src_libalidade_la_SOURCES += \
	src/prim/algebraic.c \
	src/prim/blob.c \
	src/prim/body.c src/prim/body.h \
	src/prim/box.c \
	src/prim/compile.c src/prim/compile.h \
	src/prim/cone.c \
	src/prim/csg.c src/prim/csg.h \
	src/prim/curve.h \
	src/prim/disc.c \
	src/prim/isosurface.c \
	src/prim/lathe.c \
	src/prim/layout.c src/prim/layout.h \
	src/prim/mesh.c \
	src/prim/plane.c \
	src/prim/poly.c src/prim/poly.h \
	src/prim/prim.h \
	src/prim/prism.c \
	src/prim/shape.c \
	src/prim/sphere.c \
	src/prim/superellipsoid.c \
	src/prim/sweep.c src/prim/sweep.h \
	src/prim/sweep_inner.c \
	src/prim/torus.c \
	src/prim/uv.c
