/** A value that arrives later. */
@NullMarked
package io.troupe.actor.promise;

import org.jspecify.annotations.NullMarked;
