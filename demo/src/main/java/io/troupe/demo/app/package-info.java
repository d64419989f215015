/** {@code troupe app}: runs a declared application on a simulated world. */
@NullMarked
package io.troupe.demo.app;

import org.jspecify.annotations.NullMarked;
