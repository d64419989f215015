package io.troupe.sim.worldfile;

import java.util.List;
import java.util.Map;

/**
 * A parsed file with all its includes.
 *
 * @param root its properties and entities at the top level
 * @param macros the {@code define}s by name; each is the entity from which an instance starts
 */
record Document(Entity root, Map<String, Entity> macros) {
    List<Entity> entities() {
        return root.children();
    }
}
