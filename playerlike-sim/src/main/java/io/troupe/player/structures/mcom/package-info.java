/** Structures of the Player interface mcom: messages stored for other clients. This client does not use them. */
@NullMarked
package io.troupe.player.structures.mcom;

import org.jspecify.annotations.NullMarked;
