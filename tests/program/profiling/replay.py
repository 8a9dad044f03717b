"""replay.py: fails where RenderDoc's module for Python is not installed. replay.py CAPTURE.rdc NAME OUT.png: replays all of a
capture and writes the texture of that name."""
import sys

import renderdoc

if len(sys.argv) == 1:
    sys.exit()
path, name, out = sys.argv[1:]
renderdoc.InitialiseReplay(renderdoc.GlobalEnvironment(), [])
file = renderdoc.OpenCaptureFile()
file.OpenFile(path, "", None)
result, replay = file.OpenCapture(renderdoc.ReplayOptions(), None)
if replay is None:
    sys.exit(f"FAILED: {path} cannot be replayed: {result}")
replay.SetFrameEvent(replay.GetRootActions()[-1].eventId, True)
named = {resource.resourceId for resource in replay.GetResources() if resource.name == name}
found = [texture for texture in replay.GetTextures() if texture.resourceId in named]
if len(found) != 1:
    sys.exit(f"FAILED: {len(found)} textures are called {name}")
save = renderdoc.TextureSave()
save.resourceId = found[0].resourceId
save.destType = renderdoc.FileType.PNG
save.alpha = renderdoc.AlphaMapping.Discard
replay.SaveTexture(save, out)
replay.Shutdown()
file.Shutdown()
renderdoc.ShutdownReplay()
