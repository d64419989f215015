package io.troupe.view.tools;

import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.RunLog;
import io.troupe.view.tools.FoxgloveChannels.Channel;
import io.troupe.view.tools.FoxgloveChannels.Drawn;
import java.io.Closeable;
import java.io.IOException;
import java.io.OutputStream;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

/** Writes a run as an MCAP file. */
final class McapExport implements RunListener, Closeable {
    private static final String HEADER = "troupe-run";

    private final McapWriter writer;
    private final FoxgloveChannels channels;
    private final List<Integer> ids;
    private final FoxgloveChannels.Sink sink = this::write;
    private final WorldSpec world;
    private Drawn drawn = Drawn.AT_START;
    private List<String> drawnServices = List.of();
    private List<Integer> drawnAway = List.of();

    /** @param sensorsOf indices of the robots whose sensors are written */
    McapExport(WorldSpec world, Set<Integer> sensorsOf, OutputStream out) throws IOException {
        this.world = world;
        writer = new McapWriter(out, RunLog.PROGRAM);
        channels = new FoxgloveChannels(world, sensorsOf);
        Map<MessageSchema, Integer> schemas = new EnumMap<>(MessageSchema.class);
        ids = channels.channels().stream().map(channel -> add(channel, schemas)).toList();
    }

    private int add(Channel channel, Map<MessageSchema, Integer> schemas) {
        MessageSchema schema = channel.schema();
        int id = schemas.computeIfAbsent(schema, each -> writer.schema(each.title(), "jsonschema", each.text()));
        return writer.channel(id, channel.topic(), "json", Map.of());
    }

    private void write(Channel channel, long timeNanos, byte[] json) throws IOException {
        writer.message(ids.get(channel.id()), timeNanos, json);
    }

    @Override
    public void begin(Map<String, String> header) throws IOException {
        writer.metadata(HEADER, header);
        channels.sendWorld(0, Drawn.AT_START, sink);
    }

    @Override
    public void read(Reading reading) throws IOException {
        Snapshot now = reading.snapshot();
        Drawn next = Drawn.of(now, world);
        channels.sendChanges(now.timeMicros(), drawn, next, sink);
        drawn = next;
        if (!reading.services().equals(drawnServices) || !now.away().equals(drawnAway)) {
            drawnServices = reading.services();
            drawnAway = now.away();
            channels.sendBodies(now.timeMicros(), drawnServices, drawnAway, sink);
        }
        channels.send(reading, sink);
    }

    @Override
    public void happened(Event event) throws IOException {
        switch (event) {
            case StateBegins begins -> channels.send(begins, sink);
            case Remark remark -> channels.send(remark, sink);
            case Touch touch -> {} // a remark reports the same
        }
    }

    @Override
    public void close() throws IOException {
        writer.close();
    }
}
