package io.troupe.player.wire;

/**
 * A device's address: Player's host, robot (= port), interface and index.
 *
 * <p><b>Source.</b> Player 3 protocol, address part of the message header.
 */
public record DeviceAddress(int host, int robot, int interfaceCode, int index) {}
