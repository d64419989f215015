/** Values as bytes, shared by the bus and the broker. Public for this library only; it may change at any time. */
@NullMarked
package io.troupe.bus.internal;

import org.jspecify.annotations.NullMarked;
