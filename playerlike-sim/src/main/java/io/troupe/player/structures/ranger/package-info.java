/** Data of the ranger interface: ranges of one or several elements. */
@NullMarked
package io.troupe.player.structures.ranger;

import org.jspecify.annotations.NullMarked;
