/** Promises: values that arrive later. */
@NullMarked
package io.troupe.actor.promise;

import org.jspecify.annotations.NullMarked;
