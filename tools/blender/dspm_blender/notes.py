"""What the export says: what is only close to Blender's picture, each thing once."""


class Notes:
    def __init__(self):
        self.texts = []

    def add(self, text):
        if text not in self.texts:
            self.texts.append(text)
