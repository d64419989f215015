package io.troupe.services.subsumption;

/**
 * What a colour finder sends while its service drives on.
 *
 * @param robot index of the robot that sees the colour
 * @param colour {@code 0x00RRGGBB}
 * @param secondsInCharge since the robot's service took charge, on the robot's clock
 */
public record ColourReport(int robot, int colour, double secondsInCharge) {}
