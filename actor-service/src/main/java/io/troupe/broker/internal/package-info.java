/** What the broker shares with components. Public for this library only; it may change at any time. */
@NullMarked
package io.troupe.broker.internal;

import org.jspecify.annotations.NullMarked;
