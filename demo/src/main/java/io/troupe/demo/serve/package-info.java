/** {@code troupe serve}: offers a world to Player clients over TCP; {@code troupe replay}: repeats its recordings. */
@NullMarked
package io.troupe.demo.serve;

import org.jspecify.annotations.NullMarked;
