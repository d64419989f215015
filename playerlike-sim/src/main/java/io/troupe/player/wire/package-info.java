/** What travels between a Player client and a Player server, whatever carries it. */
@NullMarked
package io.troupe.player.wire;

import org.jspecify.annotations.NullMarked;
