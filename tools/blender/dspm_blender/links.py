"""Following links backwards: through reroutes, into node groups and out of them."""
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Source:
    """An output socket, and the group nodes that lead to where it is."""
    node: Any
    socket: Any
    groups: tuple

    def input(self, name):
        """By identifier, name or index. Of inputs of one name the identifier tells which."""
        inputs = self.node.inputs
        by_identifier = next((socket for socket in inputs if socket.identifier == name), None)
        return LinkedSocket(by_identifier or inputs[name], self.groups)


@dataclass(frozen=True)
class LinkedSocket:
    """An input socket inside of group nodes."""
    socket: Any
    groups: tuple = ()

    def source(self):
        """None: the value of `end` holds."""
        found = self._trace()
        return found if isinstance(found, Source) else None

    def end(self):
        """The input whose own value holds if there is no source: this one, or that of a group node around it."""
        found = self._trace()
        return found if isinstance(found, LinkedSocket) else self

    def _trace(self):
        socket, groups = self.socket, self.groups
        while socket.is_linked and socket.links and not socket.links[0].is_muted:
            link = socket.links[0]
            node, output = link.from_node, link.from_socket
            if node.bl_idname == "NodeReroute":
                socket = node.inputs[0]
            elif node.mute and node.internal_links:
                socket = node.internal_links[0].from_socket
            elif node.bl_idname == "NodeGroupInput" and groups:
                socket, groups = inside(groups[-1].inputs, output), groups[:-1]
            elif node.bl_idname == "ShaderNodeGroup" and node.node_tree:
                end = next(each for each in node.node_tree.nodes if each.bl_idname == "NodeGroupOutput" and each.is_active_output)
                socket, groups = inside(end.inputs, output), (*groups, node)
            else:
                return Source(node, output, groups)
        return LinkedSocket(socket, groups)


def inside(sockets, wanted):
    return next(socket for socket in sockets if socket.identifier == wanted.identifier)
