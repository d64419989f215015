/** Structures of the Player interface localize: localization. This client does not use them. */
@NullMarked
package io.troupe.player.structures.localize;

import org.jspecify.annotations.NullMarked;
