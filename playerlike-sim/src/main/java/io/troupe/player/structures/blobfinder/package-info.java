/** Data of the blobfinder interface: colour blobs in a camera image. */
@NullMarked
package io.troupe.player.structures.blobfinder;

import org.jspecify.annotations.NullMarked;
