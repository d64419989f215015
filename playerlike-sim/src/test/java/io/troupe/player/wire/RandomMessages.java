package io.troupe.player.wire;

import java.lang.reflect.ParameterizedType;
import java.lang.reflect.RecordComponent;
import java.lang.reflect.Type;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/** Messages of every kind with random content. */
final class RandomMessages {
    private static final double[] ODD = {
        0, -0.0, Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, Double.MIN_VALUE, Double.MAX_VALUE
    };
    private final Random random;
    private final List<Sample> samples = new ArrayList<>();

    /** A message; only a reply needs the subtype, which is that of its request. */
    record Sample(DeviceAddress address, double timeSeconds, int subtype, Object content) {
        Content encoded() {
            return CodecTest.encode(address.interfaceCode(), subtype, content);
        }
    }

    RandomMessages(Random random) {
        this.random = random;
    }

    private double d() {
        return random.nextInt(8) == 0 ? ODD[random.nextInt(ODD.length)] : random.nextGaussian() * 100;
    }

    private boolean b() {
        return random.nextBoolean();
    }

    private String name() {
        return IntStream.range(0, random.nextInt(20))
                .mapToObj(at -> b() ? String.valueOf((char) ('a' + random.nextInt(26))) : "\u00e4")
                .reduce("", String::concat);
    }

    private Octets octets() {
        var bytes = new byte[random.nextInt(40)];
        random.nextBytes(bytes);
        return Octets.of(bytes);
    }

    private DeviceAddress address() {
        return new DeviceAddress(random.nextInt(), random.nextInt(), random.nextInt(0x10000), random.nextInt(0x10000));
    }

    private Object value(Type type) {
        if (type instanceof ParameterizedType list) {
            Type element = list.getActualTypeArguments()[0];
            return Stream.generate(() -> value(element))
                    .limit(random.nextInt(40))
                    .toList();
        }
        var known = (Class<?>) type;
        return switch (known.getSimpleName()) {
            case "double", "Double" -> d();
            case "float", "Float" -> (float) d();
            case "int" -> random.nextInt();
            case "Byte" -> (byte) random.nextInt();
            case "boolean" -> b();
            case "String" -> name();
            case "DeviceAddress" -> address();
            case "Octets" -> octets();
            case "Delivery" -> b() ? Delivery.PUSH : Delivery.PULL;
            default -> content(known);
        };
    }

    /** A record whose components are random. */
    private <T> T content(Class<T> type) {
        var components = Stream.of(type.getRecordComponents())
                .map(RecordComponent::getGenericType)
                .map(this::value)
                .toArray();
        try {
            return type.cast(type.getDeclaredConstructors()[0].newInstance(components));
        } catch (ReflectiveOperationException e) {
            throw new AssertionError(type.getName(), e);
        }
    }

    private void add(int code, int subtype, Object content) {
        var address = new DeviceAddress(random.nextInt(), random.nextInt(), code, random.nextInt(3));
        samples.add(new Sample(address, d(), subtype, content));
    }

    private void add(int code, Class<?>... types) {
        for (var type : types) {
            add(code, 0, content(type));
        }
    }

    /** At least one of each kind. */
    List<Sample> all() {
        addData();
        addRequests();
        addReplies();
        add(4, DeviceCommand.Velocity.class, DeviceCommand.GoTo.class);
        add(4, DeviceCommand.Car.class, DeviceCommand.VelocityHeading.class);
        add(3, 0, new DeviceCommand.Gripper(1 + random.nextInt(5)));
        add(31, DeviceCommand.Pause.class, DeviceCommand.Reset.class, DeviceCommand.Save.class);
        return samples;
    }

    private void addData() {
        add(4, DeviceData.Position2d.class);
        add(4, 0, new DeviceData.GeometryChanged(content(DeviceReply.Position2dGeometry.class)));
        add(5, DeviceData.SonarRanges.class);
        add(5, 0, new DeviceData.GeometryChanged(content(DeviceReply.SonarGeometry.class)));
        add(7, DeviceData.Blobs.class);
        add(62, DeviceData.RangerRanges.class, DeviceData.RangerIntensities.class);
        var ranges = content(DeviceData.RangerRanges.class);
        var intensities = content(DeviceData.RangerIntensities.class);
        var geometry = content(DeviceReply.RangerGeometry.class);
        var configuration = b() ? content(RangerConfiguration.class) : null;
        add(62, 0, new DeviceData.RangerStamped(ranges, b() ? geometry : null, configuration));
        add(62, 0, new DeviceData.RangerStamped(intensities, geometry, null));
        add(62, 0, new DeviceData.GeometryChanged(geometry));
        add(6, DeviceData.LaserScan.class);
        add(10, DeviceData.Fiducials.class);
        add(40, DeviceData.CameraImage.class);
        add(3, 0, new DeviceData.GripperState(random.nextInt(256), random.nextInt(), random.nextInt(256)));
        add(14, DeviceData.BumperStates.class);
        add(14, 0, new DeviceData.GeometryChanged(content(DeviceReply.BumperGeometry.class)));
    }

    private void addRequests() {
        add(4, DeviceRequest.Geometry.class, DeviceRequest.Power.class, DeviceRequest.VelocityMode.class);
        add(4, DeviceRequest.PositionMode.class, DeviceRequest.SetOdometry.class, DeviceRequest.ResetOdometry.class);
        add(4, DeviceRequest.SpeedPid.class, DeviceRequest.PositionPid.class, DeviceRequest.SpeedProfile.class);
        add(4, DeviceRequest.SetIntegerProperty.class);
        add(5, DeviceRequest.Geometry.class, DeviceRequest.Power.class);
        add(7, DeviceRequest.SetColour.class, DeviceRequest.SetImager.class, DeviceRequest.GetColour.class);
        add(62, DeviceRequest.Geometry.class, DeviceRequest.Power.class, DeviceRequest.Intensities.class);
        add(62, DeviceRequest.SetRangerConfiguration.class, DeviceRequest.GetConfiguration.class);
        add(6, DeviceRequest.Geometry.class, DeviceRequest.Power.class, DeviceRequest.LaserId.class);
        add(6, DeviceRequest.SetLaserConfiguration.class, DeviceRequest.GetConfiguration.class);
        add(31, DeviceRequest.GetPose.class, DeviceRequest.SetPose.class, DeviceRequest.Capability.class);
        add(31, DeviceRequest.GetPose3d.class, DeviceRequest.SetPose3d.class, DeviceRequest.SetProperty.class);
        add(31, 0, new DeviceRequest.GetProperty(name(), name(), random.nextInt(), random.nextInt(40)));
        add(10, DeviceRequest.Geometry.class, DeviceRequest.GetFieldOfView.class, DeviceRequest.SetFieldOfView.class);
        add(10, DeviceRequest.GetMarker.class, DeviceRequest.SetMarker.class);
        add(14, DeviceRequest.Geometry.class);
        add(40, DeviceRequest.GetImage.class);
        add(3, DeviceRequest.Geometry.class);
        add(66, DeviceRequest.Capability.class);
        add(66, 0, new DeviceRequest.Unknown(random.nextInt(255)));
        add(1, PlayerRequest.DeviceList.class, PlayerRequest.DriverInfo.class, PlayerRequest.NextData.class);
        add(1, PlayerRequest.DataMode.class, PlayerRequest.Capability.class);
        add(1, 0, new PlayerRequest.Access(address(), random.nextInt(256)));
        var rule = content(ReplaceRule.class);
        add(
                1,
                0,
                new PlayerRequest.AddRule(new ReplaceRule(
                        rule.interfaceCode(), rule.index(), rule.type(), rule.subtype(), random.nextInt(3))));
        add(1, 0, new PlayerRequest.Other(7 + random.nextInt(2)));
    }

    private void addReplies() {
        add(4, 1, content(DeviceReply.Position2dGeometry.class));
        add(4, 2, new DeviceReply.Ack());
        add(4, 3, new DeviceReply.Nack("refused by the server"));
        add(5, 1, content(DeviceReply.SonarGeometry.class));
        add(7, 3, content(DeviceReply.Colour.class));
        add(62, 1, content(DeviceReply.RangerGeometry.class));
        add(62, 4, content(DeviceReply.OfRanger.class));
        add(62, 5, content(DeviceReply.OfRanger.class));
        add(6, 1, content(DeviceReply.LaserGeometry.class));
        add(6, 2, content(DeviceReply.OfLaser.class));
        add(6, 3, content(DeviceReply.OfLaser.class));
        add(6, 5, content(DeviceReply.LaserId.class));
        add(10, 1, content(DeviceReply.FiducialGeometry.class));
        add(10, 2, content(DeviceReply.FieldOfView.class));
        add(10, 3, content(DeviceReply.FieldOfView.class));
        add(10, 7, content(DeviceReply.Marker.class));
        add(10, 8, content(DeviceReply.Marker.class));
        add(14, 1, content(DeviceReply.BumperGeometry.class));
        add(40, 3, content(DeviceReply.Image.class));
        var gripper = content(DeviceReply.GripperGeometry.class);
        add(
                3,
                1,
                new DeviceReply.GripperGeometry(
                        gripper.pose(), gripper.outer(), gripper.inner(), random.nextInt(256), random.nextInt(256)));
        add(31, 1, content(DeviceReply.ModelPose.class));
        add(31, 2, new DeviceReply.Ack());
        add(31, 3, content(DeviceReply.ModelPose3d.class));
        add(31, 5, content(DeviceReply.ModelProperty.class));
        add(1, 1, content(PlayerReply.DeviceList.class));
        add(1, 2, content(PlayerReply.DriverInfo.class));
        add(1, 3, new PlayerReply.Access(address(), 2, name()));
    }
}
