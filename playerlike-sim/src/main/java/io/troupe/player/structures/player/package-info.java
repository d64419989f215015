/** What the server tells about itself. */
@NullMarked
package io.troupe.player.structures.player;

import org.jspecify.annotations.NullMarked;
