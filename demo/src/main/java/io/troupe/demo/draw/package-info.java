/** {@code troupe draw}: a picture of a world. */
@NullMarked
package io.troupe.demo.draw;

import org.jspecify.annotations.NullMarked;
