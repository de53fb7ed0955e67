#pragma once

// OpenNI's header for drivers leans on a library that is not shipped with it.
// NOLINTBEGIN
#define XN_NEW(type, arg) new type(arg)
#define XN_DELETE(pointer) delete pointer
#include <Driver/OniDriverAPI.h>
// NOLINTEND
