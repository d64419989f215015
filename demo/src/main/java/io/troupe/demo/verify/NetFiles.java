package io.troupe.demo.verify;

import io.troupe.demo.terminal.OutputFiles;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.drawing.GraphDrawing;
import io.troupe.petri.drawing.NetDrawing;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;

/** Writes nets and graphs to a directory as PNML, DOT and SVG. */
final class NetFiles {
    private final Path directory;

    NetFiles(Path directory) {
        this.directory = directory;
    }

    /**
     * Writes all files of one reading: both nets, the shortest trace to a deadlock, the net with low priorities, and
     * the graphs.
     */
    void write(ReadingStudy study) throws IOException {
        var reading = study.reading();
        writeWhole("uncorrected-" + reading, study.uncorrected().net());
        writeWhole("corrected-" + reading, study.corrected().net());
        writeWhole("low-priority-" + reading, study.lowPriority());
        writeDeadlock("deadlock-" + reading, study.uncorrected().graph());
        write("graph-robot-player-" + reading, study.robotAndPlayer().graph());
        write(
                "graph-middleware-service-" + reading,
                study.middlewareAndService().graph());
        write("graph-uncorrected-" + reading, study.uncorrected().graph());
        write("graph-corrected-" + reading, study.corrected().graph());
    }

    /** Writes the net of all four components, each in a different tint. */
    private void writeWhole(String name, PetriNet net) throws IOException {
        OutputFiles.write(directory.resolve(name + ".pnml"), Pnml.toText(net));
        draw(name, net, NetDrawing.of(net).tinting(PaperNets.components(net)));
    }

    void write(String name, PetriNet net) throws IOException {
        OutputFiles.write(directory.resolve(name + ".pnml"), Pnml.toText(net));
        draw(name, net);
    }

    void draw(String name, PetriNet net) throws IOException {
        draw(name, net, NetDrawing.of(net));
    }

    /** Draws the net in its nearest dead marking, with the trace to it. Writes nothing if there is none. */
    void writeDeadlock(String name, ReachabilityGraph graph) throws IOException {
        List<ReachabilityGraph.State> dead = graph.dead();
        if (!dead.isEmpty()) {
            var nearest = dead.get(0);
            draw(
                    name,
                    graph.net(),
                    NetDrawing.of(graph.net()).marked(nearest.marking()).highlighting(nearest.shortestTrace()));
        }
    }

    /** Draws the graph, with the trace to the nearest dead marking if there is one. */
    void write(String name, ReachabilityGraph graph) throws IOException {
        var drawing = GraphDrawing.of(graph);
        List<ReachabilityGraph.State> dead = graph.dead();
        if (!dead.isEmpty()) {
            drawing = drawing.pathTo(dead.get(0));
        }
        OutputFiles.write(directory.resolve(name + ".dot"), drawing.dot());
        if (canDraw(graph)) {
            OutputFiles.write(directory.resolve(name + ".svg"), drawing.svg());
        }
    }

    /** Whether a graph is small enough for SVG. */
    static boolean canDraw(ReachabilityGraph graph) {
        return graph.size() <= GraphDrawing.MOST_SVG_MARKINGS && graph.edgeCount() <= GraphDrawing.MOST_SVG_EDGES;
    }

    /** Whether a net is small enough for SVG. */
    static boolean canDraw(PetriNet net) {
        return net.places().size() + net.transitions().size() <= NetDrawing.MOST_SVG_NODES
                && net.arcCount() <= NetDrawing.MOST_SVG_ARCS;
    }

    /** The size of a net, and the largest size that is drawn. */
    static String size(PetriNet net) {
        return net.places().size() + net.transitions().size() + " places and transitions (drawn up to "
                + NetDrawing.MOST_SVG_NODES + ") and " + net.arcCount() + " arcs (up to " + NetDrawing.MOST_SVG_ARCS
                + ")";
    }

    /** Path of a file without its extension. */
    String path(String name) {
        return directory.resolve(name).toString();
    }

    void drawDeadlock(String name, PetriNet net, DeadlockSearch.Deadlock deadlock) throws IOException {
        draw(name, net, NetDrawing.of(net).marked(deadlock.marking()).highlighting(deadlock.trace()));
    }

    private void draw(String name, PetriNet net, NetDrawing drawing) throws IOException {
        OutputFiles.write(directory.resolve(name + ".dot"), drawing.dot());
        if (canDraw(net)) {
            OutputFiles.write(directory.resolve(name + ".svg"), drawing.svg());
        }
    }
}
