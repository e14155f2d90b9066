"""USD by OpenUSD: layers, geometry, materials, joints, and the stage that holds them."""
