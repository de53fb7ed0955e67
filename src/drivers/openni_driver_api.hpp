#pragma once

// OpenNI2's driver header counts on a header that is not shipped with it for these.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#ifndef TRUE
#define TRUE 1
#endif
#ifndef FALSE
#define FALSE 0
#endif
#include <Driver/OniDriverAPI.h>
