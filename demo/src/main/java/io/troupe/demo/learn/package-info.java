/** {@code troupe learn}: worlds as a library, with two examples and a process that other programs step worlds in. */
@NullMarked
package io.troupe.demo.learn;

import org.jspecify.annotations.NullMarked;
