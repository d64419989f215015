/**
 * The messages between a Player client and a Player server, independent of the transport, and their transport over TCP.
 */
@NullMarked
package io.troupe.player.wire;

import org.jspecify.annotations.NullMarked;
