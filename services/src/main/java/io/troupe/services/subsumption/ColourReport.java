package io.troupe.services.subsumption;

/**
 * The message that a colour finder sends for each colour it sees while its service runs.
 *
 * @param robot index of the robot that sees the colour
 * @param colour {@code 0x00RRGGBB}
 * @param secondsInCharge time since the robot's service started to drive it, on the robot's clock
 */
public record ColourReport(int robot, int colour, double secondsInCharge) {}
