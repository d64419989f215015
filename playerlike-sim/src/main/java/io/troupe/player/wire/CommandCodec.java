package io.troupe.player.wire;

import io.troupe.player.wire.DeviceCommand.Car;
import io.troupe.player.wire.DeviceCommand.GoTo;
import io.troupe.player.wire.DeviceCommand.Gripper;
import io.troupe.player.wire.DeviceCommand.Pause;
import io.troupe.player.wire.DeviceCommand.Reset;
import io.troupe.player.wire.DeviceCommand.Save;
import io.troupe.player.wire.DeviceCommand.Velocity;
import io.troupe.player.wire.DeviceCommand.VelocityHeading;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/** Encodes and decodes CMD messages to devices. */
final class CommandCodec {
    private CommandCodec() {}

    static Content encode(DeviceCommand command) {
        var out = new XdrWriter();
        int subtype = write(out, command);
        return new Content(subtype, out.bytes());
    }

    private static int write(XdrWriter out, DeviceCommand command) {
        return switch (command) {
            case Velocity speed -> {
                out.float64(speed.vx(), speed.vy(), speed.va()).bool(speed.enabled());
                yield 1;
            }
            case GoTo goal -> {
                out.float64(goal.px(), goal.py(), goal.pa(), goal.vx(), goal.vy(), goal.va())
                        .bool(goal.enabled());
                yield 2;
            }
            case Car car -> {
                out.float64(car.velocityMps(), car.angleRad());
                yield 3;
            }
            case VelocityHeading heading -> {
                out.float64(heading.velocityMps(), heading.headingRad());
                yield 4;
            }
            case Gripper gripper -> gripper.order();
            case Pause pause -> 1;
            case Reset reset -> 2;
            case Save save -> 3;
        };
    }

    /** Empty for an unknown command. */
    static Optional<DeviceCommand> decode(int interfaceCode, int subtype, byte[] payload) throws WireException {
        var in = new XdrReader(Interfaces.name(interfaceCode) + " CMD " + subtype, payload);
        DeviceCommand command = null;
        if (interfaceCode == Interfaces.POSITION2D.code()) {
            command = position(subtype, in);
        } else if (interfaceCode == Interfaces.SIMULATION.code()) {
            command = switch (subtype) {
                case 1 -> new Pause();
                case 2 -> new Reset();
                case 3 -> new Save();
                default -> null;
            };
        } else if (interfaceCode == Interfaces.GRIPPER.code() && subtype >= 1 && subtype <= 5) {
            command = new Gripper(subtype);
        }
        if (command != null) {
            in.end();
        }
        return Optional.ofNullable(command);
    }

    private static @Nullable DeviceCommand position(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 -> new Velocity(in.float64("vx"), in.float64("vy"), in.float64("va"), in.bool("state"));
            case 2 ->
                new GoTo(
                        in.float64("px"),
                        in.float64("py"),
                        in.float64("pa"),
                        in.float64("vx"),
                        in.float64("vy"),
                        in.float64("va"),
                        in.bool("state"));
            case 3 -> new Car(in.float64("velocity"), in.float64("angle"));
            case 4 -> new VelocityHeading(in.float64("velocity"), in.float64("heading"));
            default -> null;
        };
    }
}
