/**
 * The client's view of a robot: the names of the Player Java client.
 *
 * <p>A program begins with {@link io.troupe.player.PlayerClient}. Samples are in the documentation of the client and of
 * the interfaces that work: position2d, sonar, laser, blobfinder, ranger and simulation. The other interfaces exist so
 * that programs compile, and their methods throw; the classes in {@code structures} only hold the fields of messages.
 */
@NullMarked
package io.troupe.player;

import org.jspecify.annotations.NullMarked;
