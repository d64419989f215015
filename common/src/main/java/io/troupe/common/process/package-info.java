/** Starts and ends other programs. */
@NullMarked
package io.troupe.common.process;

import org.jspecify.annotations.NullMarked;
