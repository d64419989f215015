package io.troupe.view.live;

import io.troupe.sim.Snapshot;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Base64;
import java.util.List;
import java.util.Objects;
import java.util.stream.IntStream;
import java.util.zip.GZIPOutputStream;
import org.jspecify.annotations.Nullable;

/**
 * Collects a whole run for a page in a file, which plays it and loads nothing: the messages of a live page, with every
 * frame. Of a run with more than {@value #MOST_ROBOTS_IN_FULL} robots it keeps a frame for each second, and no
 * readings.
 *
 * {@snippet :
 * var file = new ViewFile();
 * var viewed = new ViewedRun(scenario.world(), table, new RunControl(0, false)).onto(file);
 * result = run.run(log, viewed.listener(RecordedRun.Listener.NONE));
 * Files.writeString(folder.resolve("run.html"), file.html());
 * }
 *
 * <p><b>Threads.</b> One at a time.
 */
public final class ViewFile implements ViewSink {
    private static final int MOST_ROBOTS_IN_FULL = 10;

    private static final long CROWD_MICROS = 1_000_000;

    private final ByteArrayOutputStream content = new ByteArrayOutputStream();
    private final GZIPOutputStream packed;
    private @Nullable ViewedWorld world;

    public ViewFile() {
        try {
            packed = new GZIPOutputStream(content);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    // ---- called by the run that it shows

    @Override
    public void world(ViewedWorld begun) {
        world = begun;
        write(ViewMessages.text(ViewMessages.WORLD, begun.json()));
    }

    @Override
    public void frame(ViewFrame frame) {
        ViewedWorld of = Objects.requireNonNull(world, "a frame before its world");
        Snapshot snapshot = frame.snapshot();
        int robots = snapshot.robots().size();
        boolean full = robots <= MOST_ROBOTS_IN_FULL;
        if (full || snapshot.timeMicros() % CROWD_MICROS == 0) {
            var timeless = new ViewFrame(frame.number(), snapshot, frame.states(), 0);
            write(ViewMessages.frame(of, timeless, false));
        }
        if (full) {
            List<Integer> all = IntStream.range(0, robots).boxed().toList();
            write(ViewMessages.devices(frame, all));
            write(ViewMessages.sensors(frame, all));
        }
    }

    @Override
    public void event(String json) {
        write(ViewMessages.text(ViewMessages.EVENTS, "[" + json + "]"));
    }

    private void write(byte[] message) {
        try {
            packed.write(message);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** The page with everything that was collected. */
    public String html() {
        try {
            packed.close();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return ViewPage.playing(Base64.getEncoder().encodeToString(content.toByteArray()))
                .html();
    }
}
