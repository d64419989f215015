/** Data of the blobfinder interface: patches of colour in a camera image. */
@NullMarked
package io.troupe.player.structures.blobfinder;

import org.jspecify.annotations.NullMarked;
