package io.troupe.view.tools;

import io.troupe.sim.RobotReading;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.io.BufferedWriter;
import java.io.Closeable;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.Consumer;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * Writes a run as tables, each a CSV file with a line of titles. Tables of further devices are written if the world has
 * such devices, and that of intensities if some are measured.
 *
 * <p><b>Units and shapes.</b> In the titles. Robots count from 1. An empty cell means that there is no value.
 */
final class CsvExport implements RunListener, Closeable {
    /** The tables; a file has the name of its table. */
    enum Table {
        POSES("time_s,robot,name,x_m,y_m,heading_rad,gap_m,service,forward_mps,turn_radps,stalled"),
        RANGES("time_s,robot,device"), // and a column for each range
        BLOBS("time_s,robot,colour,left_px,right_px,top_px,bottom_px,area_px2,range_m"),
        INTENSITIES("time_s,robot,device"), // and a column for each intensity
        FIDUCIALS("time_s,robot,device,id,x_m,y_m,heading_rad"),
        BUMPERS("time_s,robot,device"), // and a column for each bumper
        GRIPPERS("time_s,robot,device,paddles,outer_beam,inner_beam,holds"),
        STATES("time_s,state,robot,colour,services"),
        CONTACTS("time_s,robot,service,other"),
        LOG("time_s,level,source,text");

        private final String titles;

        Table(String titles) {
            this.titles = titles;
        }

        String fileName() {
            return name().toLowerCase(Locale.ROOT) + ".csv";
        }
    }

    private final WorldSpec world;
    private final Path directory;
    private final Consumer<Path> opened;
    private final List<DeviceNames> names; // by robot
    private final int mostRanges;
    private final int mostBumpers;
    private final Map<Table, BufferedWriter> writers = new EnumMap<>(Table.class);
    private final StringBuilder row = new StringBuilder();

    /**
     * @param directory exists
     * @param opened is called with each file before it is written
     */
    CsvExport(WorldSpec world, Path directory, Consumer<Path> opened) throws IOException {
        this.world = world;
        this.directory = directory;
        this.opened = opened;
        names = world.robots().stream().map(DeviceNames::of).toList();
        mostRanges =
                world.robots().stream().mapToInt(CsvExport::mostRanges).max().orElse(0);
        mostBumpers = devices(world)
                .mapToInt(device -> device instanceof DeviceSpec.Bumpers(var parts) ? parts.size() : 0)
                .max()
                .orElse(0);
        try {
            for (Table table : Table.values()) {
                if (isForEveryRunIn(world, table)) {
                    writer(table);
                } else {
                    Files.deleteIfExists(directory.resolve(table.fileName())); // of another run
                }
            }
        } catch (IOException e) {
            closeAfter(e);
            throw e;
        }
    }

    private static Stream<DeviceSpec> devices(WorldSpec world) {
        return world.robots().stream().flatMap(robot -> robot.devices().stream());
    }

    private static boolean isForEveryRunIn(WorldSpec world, Table table) {
        return switch (table) {
            case POSES, RANGES, BLOBS, STATES, CONTACTS, LOG -> true;
            case INTENSITIES ->
                world.robots().stream()
                        .flatMap(robot -> robot.rangers().stream())
                        .anyMatch(RangerSpec::intensities);
            case FIDUCIALS -> devices(world).anyMatch(DeviceSpec.FiducialFinder.class::isInstance);
            case BUMPERS -> devices(world).anyMatch(DeviceSpec.Bumpers.class::isInstance);
            case GRIPPERS -> devices(world).anyMatch(DeviceSpec.Gripper.class::isInstance);
        };
    }

    /** The writer of a table, which is created with its titles when it is first needed. */
    private BufferedWriter writer(Table table) throws IOException {
        BufferedWriter known = writers.get(table);
        if (known != null) {
            return known;
        }
        Path file = directory.resolve(table.fileName());
        opened.accept(file);
        BufferedWriter writer = Files.newBufferedWriter(file);
        writers.put(table, writer);
        writer.append(table.titles);
        switch (table) {
            case RANGES -> appendTitles(writer, mostRanges, "range_%d_m");
            case INTENSITIES -> appendTitles(writer, mostRanges, "intensity_%d");
            case BUMPERS -> appendTitles(writer, mostBumpers, "bumper_%d");
            default -> {}
        }
        writer.append('\n');
        return writer;
    }

    private static void appendTitles(BufferedWriter writer, int count, String title) throws IOException {
        for (int i = 1; i <= count; i++) {
            writer.append(',').append(String.format(Locale.ROOT, title, i));
        }
    }

    private static int mostRanges(RobotSpec robot) {
        int sonars = robot.sonar() == null ? 0 : robot.sonar().mounts().size();
        return IntStream.concat(
                        IntStream.of(sonars),
                        robot.rangers().stream()
                                .mapToInt(ranger -> ranger.sensors().stream()
                                        .mapToInt(RangeSensorSpec::samples)
                                        .sum()))
                .max()
                .orElse(0);
    }

    @Override
    public void begin(Map<String, String> header) {}

    @Override
    public void read(Reading reading) throws IOException {
        long micros = reading.snapshot().timeMicros();
        for (int i = 0; i < world.robots().size(); i++) {
            RobotReading now = reading.snapshot().robots().get(i);
            begin(micros).cell(i + 1).cell(world.robots().get(i).name());
            cell(now.pose().x()).cell(now.pose().y()).cell(now.pose().headingRad());
            cell(now.wallGapM()).cell(reading.services().get(i));
            if (reading.hasSpeeds()) {
                cell(now.odometry().forwardMps()).cell(now.odometry().turnRadps());
                cell(now.odometry().stalled() ? 1 : 0);
            } else {
                cell("").cell("").cell("");
            }
            end(Table.POSES);
            writeRanges(micros, i, now);
            writeBlobs(micros, i, now);
            writeDevices(micros, i, now);
        }
    }

    private void writeRanges(long micros, int robot, RobotReading now) throws IOException {
        writeRanges(Table.RANGES, micros, robot, "sonar", now.sonarM());
        for (int i = 0; i < now.rangersM().size(); i++) {
            String device = names.get(robot).rangers().get(i);
            writeRanges(Table.RANGES, micros, robot, device, now.rangersM().get(i));
            if (i < now.intensities().size() && !now.intensities().get(i).isEmpty()) {
                writeRanges(
                        Table.INTENSITIES,
                        micros,
                        robot,
                        device,
                        now.intensities().get(i));
            }
        }
    }

    private void writeRanges(Table table, long micros, int robot, String device, @Nullable List<Double> rangesM)
            throws IOException {
        if (rangesM != null) {
            begin(micros).cell(robot + 1).cell(device);
            for (int i = 0; i < mostRanges; i++) {
                if (i < rangesM.size()) {
                    cell(rangesM.get(i));
                } else {
                    cell("");
                }
            }
            end(table);
        }
    }

    private void writeBlobs(long micros, int robot, RobotReading now) throws IOException {
        if (now.blobs() != null) {
            for (ColourBlob blob : now.blobs().blobs()) {
                begin(micros).cell(robot + 1).cell(RunListener.hex(blob.colour()));
                cell(blob.left()).cell(blob.right()).cell(blob.top()).cell(blob.bottom());
                cell(blob.areaPx2()).cell(blob.rangeM()).end(Table.BLOBS);
            }
        }
    }

    private void writeDevices(long micros, int robot, RobotReading now) throws IOException {
        for (int i = 0; i < now.devices().size(); i++) {
            writeDevice(
                    micros,
                    robot,
                    names.get(robot).others().get(i),
                    now.devices().get(i));
        }
    }

    private void writeDevice(long micros, int robot, String device, DeviceReading reading) throws IOException {
        switch (reading) {
            case DeviceReading.Fiducials(var seen) -> {
                for (DeviceReading.Fiducial marker : seen) {
                    begin(micros).cell(robot + 1).cell(device).cell(marker.id());
                    cell(marker.x()).cell(marker.y()).cell(marker.headingRad()).end(Table.FIDUCIALS);
                }
            }
            case DeviceReading.Pressed(var bumpers) -> {
                begin(micros).cell(robot + 1).cell(device);
                for (int i = 0; i < mostBumpers; i++) {
                    cell(i >= bumpers.size() ? "" : bumpers.get(i) ? "1" : "0");
                }
                end(Table.BUMPERS);
            }
            case DeviceReading.Grip(var paddles, boolean outer, boolean inner, boolean holds) ->
                begin(micros)
                        .cell(robot + 1)
                        .cell(device)
                        .cell(paddles.name().toLowerCase(Locale.ROOT))
                        .cell(outer ? 1 : 0)
                        .cell(inner ? 1 : 0)
                        .cell(holds ? 1 : 0)
                        .end(Table.GRIPPERS);
            case DeviceReading.Picture picture -> {} // pixels are of no use in a table
            case DeviceReading.Unknown unknown -> {}
        }
    }

    @Override
    public void happened(Event event) throws IOException {
        begin(event.timeMicros());
        switch (event) {
            case StateBegins begins -> {
                cell(begins.state());
                if (begins.robot() == 0) {
                    cell("");
                } else {
                    cell(begins.robot());
                }
                cell(RunListener.hex(begins.colour()));
                cell(String.join(";", begins.services())).end(Table.STATES);
            }
            case Touch touch ->
                cell(touch.robot()).cell(touch.service()).cell(touch.other()).end(Table.CONTACTS);
            case Remark remark ->
                cell(remark.level().name().toLowerCase(Locale.ROOT))
                        .cell(remark.source())
                        .cell(remark.text())
                        .end(Table.LOG);
        }
    }

    // ---- rows

    private CsvExport begin(long timeMicros) {
        row.setLength(0);
        row.append(timeMicros / 1e6);
        return this;
    }

    private CsvExport cell(int number) {
        row.append(',').append(number);
        return this;
    }

    /** An infinite number means that there is nothing. */
    private CsvExport cell(double number) {
        row.append(',');
        if (Double.isFinite(number)) {
            row.append(number);
        }
        return this;
    }

    private CsvExport cell(String text) {
        row.append(',');
        if (text.matches("[^\",\\r\\n]*")) {
            row.append(text);
        } else {
            row.append('"').append(text.replace("\"", "\"\"")).append('"');
        }
        return this;
    }

    private void end(Table table) throws IOException {
        row.append('\n');
        writer(table).append(row);
    }

    /** Closes all files, and throws the first failure. */
    @Override
    public void close() throws IOException {
        IOException failure = null;
        for (BufferedWriter writer : new ArrayList<>(writers.values())) {
            try {
                writer.close();
            } catch (IOException e) {
                failure = failure == null ? e : failure;
            }
        }
        if (failure != null) {
            throw failure;
        }
    }

    private void closeAfter(IOException failure) {
        try {
            close();
        } catch (IOException further) {
            failure.addSuppressed(further);
        }
    }
}
