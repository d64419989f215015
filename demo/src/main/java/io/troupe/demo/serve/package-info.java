/** {@code troupe serve}: a world for Player clients behind sockets. */
@NullMarked
package io.troupe.demo.serve;

import org.jspecify.annotations.NullMarked;
